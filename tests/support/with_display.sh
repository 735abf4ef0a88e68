#!/bin/sh
# Runs a program on a display of its own; exits 77 (skipped) where there is no Xvfb.
#   with_display.sh PROGRAM ARGUMENTS...
set -u
if ! command -v Xvfb >/dev/null 2>&1; then
    echo "skipped: Xvfb is not installed"
    exit 77
fi
work=$(mktemp -d)
# Xvfb picks a free display and writes its number when it is ready. -noreset: it would otherwise start anew whenever its last
# client leaves, and the next client could find no display.
mkfifo "$work/display"
Xvfb -displayfd 3 -noreset -screen 0 1024x768x24 -nolisten tcp 3>"$work/display" >"$work/xvfb.log" 2>&1 &
xvfb=$!
trap 'kill $xvfb 2>/dev/null; wait $xvfb 2>/dev/null; rm -rf "$work"' EXIT
read -r number <"$work/display" || { echo "Xvfb did not start:"; cat "$work/xvfb.log"; exit 1; }
DISPLAY=:$number
SDL_VIDEODRIVER=x11
XDG_RUNTIME_DIR=${XDG_RUNTIME_DIR:-$work}
export DISPLAY SDL_VIDEODRIVER XDG_RUNTIME_DIR
unset WAYLAND_DISPLAY
"$@"
