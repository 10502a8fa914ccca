#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Makes docs/pictures/panel-*.jpg: ParaView's window with each of the plugin's filters.
# Usage: docs/panels.sh [--output DIR] [--data wavelet|head|bytes] [FILTER...], by the names in panels.py
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/../scripts/common.sh"

output=$root/docs/pictures
data=wavelet
while [[ ${1:-} == --* ]]; do
  case $1 in
    --output) output=$(realpath "$2") ;;
    --data) data=$2 ;;
    *) echo "panels.sh: unknown option '$1'" >&2; exit 1 ;;
  esac
  shift 2
done
filters=("$@")
if [ ${#filters[@]} -eq 0 ]; then
  filters=(contour contour_tolerance contour_region interval_volume hierarchy extract points diamond_mesh)
fi

# shellcheck disable=SC2086 # lists of words
install_packages $render_packages $demo_packages paraview xdotool imagemagick libqt5svg5 fonts-dejavu-core
install_build_packages
configure_and_build release >/dev/null

export ISODIAMONDS_PLUGIN
ISODIAMONDS_PLUGIN=$(find_plugin)
export ISODIAMONDS_HEAD=/usr/share/mricron/templates/ch2.nii.gz ISODIAMONDS_DATA=$data
export PYTHONPATH=$build/lib/python3/dist-packages
settings=$(mktemp -d) # nobody's own settings in the pictures
export XDG_CONFIG_HOME=$settings HOME=$settings ISODIAMONDS_READY=$settings/ready

# drag X Y TO_X TO_Y
drag() {
  local step
  xdotool mousemove "$1" "$2" mousedown 1
  for step in 1 2 3 4 5 6 7 8; do
    xdotool mousemove $(($1 + ($3 - $1) * step / 8)) $(($2 + ($4 - $2) * step / 8))
    sleep 0.1
  done
  xdotool mouseup 1
}

# In the window of one filter: waits for the script, for drawing, and takes a picture.
take_picture() {
  paraview --dr --script="$root/docs/panels.py" >"$settings/log" 2>&1 &
  local paraview=$! window seconds=0
  while [ ! -e "$ISODIAMONDS_READY" ] && [ $((seconds++)) -lt 120 ]; do sleep 1; done
  [ -e "$ISODIAMONDS_READY" ] || { cat "$settings/log" >&2; exit 1; }
  window=$(xdotool search --onlyvisible --name ParaView | tail -1)
  xdotool windowsize "$window" 1200 1130 windowmove "$window" 0 0
  sleep 2
  # Room for the properties: the borders to the view and to the pipeline browser.
  drag 297 700 460 700
  drag 200 483 200 240
  sleep 4
  import -window root -quality 85 "$output/panel-${ISODIAMONDS_PANEL//_/-}.jpg"
  kill $paraview
  wait $paraview || true
}
export root output settings

mkdir -p "$output"
for filter in "${filters[@]}"; do
  rm -f "$ISODIAMONDS_READY"
  ISODIAMONDS_PANEL=$filter xvfb-run -a -s "-screen 0 1200x1130x24 -noreset" bash -euc "$(declare -f drag take_picture); take_picture"
  echo "$output/panel-${filter//_/-}.jpg"
done
rm -r "$settings"
