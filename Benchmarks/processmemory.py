# SPDX-License-Identifier: BSD-3-Clause
"""What this process has in memory (Linux only)."""


def memory(entry):
    """In MiB: VmRSS, what the process has in memory, or VmHWM, the most that it has had."""
    with open("/proc/self/status", encoding="ascii") as status:
        line = next(line for line in status if line.startswith(entry))
    return int(line.split()[1]) / 1024


def forget_peak():
    """Resets VmHWM."""
    with open("/proc/self/clear_refs", "w", encoding="ascii") as file:
        file.write("5")
