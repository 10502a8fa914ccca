# SPDX-License-Identifier: BSD-3-Clause
"""What this process has in memory (Linux only)."""


def memory(entry):
    """VmRSS, what the process has in memory, or VmHWM, the most that it had, in MiB."""
    with open("/proc/self/status", encoding="ascii") as status:
        line = next(line for line in status if line.startswith(entry))
    return int(line.split()[1]) / 1024


def forget_peak():
    """VmHWM begins anew."""
    with open("/proc/self/clear_refs", "w", encoding="ascii") as file:
        file.write("5")
