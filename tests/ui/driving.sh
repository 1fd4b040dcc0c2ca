# Shell functions for scripts that drive the window with real events; sourced, not run. They wait
# for states, which the program writes into $folder/status.json, never for times.
# The script sets: studio (the program), folder (its own, made anew).

export LIBGL_ALWAYS_SOFTWARE=1

# Starts the script again with a screen of its own. Without a reset, which a server does when the last
# window has gone: it would refuse the next one meanwhile.
with_screen() {
  local size=$1
  shift
  if [ -z "${HEWN_UI_INSIDE:-}" ]; then
    export HEWN_UI_INSIDE=1
    exec xvfb-run -a -s "-screen 0 ${size}x24 -noreset" "$0" "$@"
  fi
}
fail() {
  echo "FAILED: $*" >&2
  cat "$folder/studio.txt" "$folder/status.json" >&2 2>/dev/null || true
  xdotool key F12 2>/dev/null || true  # what it looked like
  sleep 1
  kill "$pid" 2>/dev/null || true
  exit 1
}
# The value of a name in the window's state.
state() { sed -n 's/.*"'"$1"'":\("[^"]*"\|[^,}]*\).*/\1/p' "$folder/status.json" | tr -d '"'; }
is() { [ "$(state "$1")" = "$2" ]; }
at_least() { [ "$(state "$1")" -ge "$2" ]; }
is_picked() { [ -n "$(state picked)" ]; }
is_idle() { is busy false && is is_rough false; }
begins() { case "$(state "$1")" in "$2"*) return 0 ;; *) return 1 ;; esac; }
# until_true WHAT COMMAND...: waits up to three minutes.
until_true() {
  local what=$1
  shift
  for _ in $(seq 1800); do
    if "$@" 2>/dev/null; then return 0; fi
    kill -0 "$pid" 2>/dev/null || fail "the window is gone; waited for: $what"
    sleep 0.1
  done
  fail "waited in vain: $what"
}
# within TENTHS COMMAND...: whether it comes true in that many tenths of a second.
within() {
  local tenths=$1
  shift
  for _ in $(seq "$tenths"); do
    if "$@" 2>/dev/null; then return 0; fi
    sleep 0.1
  done
  return 1
}
# soon COMMAND...: whether it comes true within some slow frames, as sanitizers make them.
soon() { within 15 "$@"; }
# A key that is down for less than a frame is not seen: sanitizers make frames long.
key() { xdotool key --delay "${HEWN_KEY_DELAY:-60}" "$@"; }
# write_over NAME TEXT: over what is in the field that the state calls NAME. Once more when a slow
# frame took a letter for a shortcut.
write_over() {
  for _ in 1 2 3 4 5; do
    key ctrl+a
    xdotool type --delay "${HEWN_KEY_DELAY:-60}" "$2"
    if soon is "$1" "$2"; then return 0; fi
  done
  fail "cannot write '$2'"
}
click() {
  xdotool mousemove "$1" "$2"
  sleep 0.3
  xdotool mousedown 1
  sleep 0.15
  xdotool mouseup 1
  sleep 0.15
}
drag() {
  local button=${5:-1}
  xdotool mousemove "$1" "$2"
  sleep 0.2
  xdotool mousedown "$button"
  for i in 1 2 3 4 5 6; do
    xdotool mousemove $(($1 + ($3 - $1) * i / 6)) $(($2 + ($4 - $2) * i / 6))
    sleep 0.1
  done
  xdotool mouseup "$button"
}
# Moves the mouse over a grid until the state's NAME begins with TEXT: scan NAME TEXT X0 Y0 X1 Y1 STEP
scan() {
  local name=$1 text=$2 x y
  for y in $(seq "$4" "$7" "$6"); do
    for x in $(seq "$3" "$7" "$5"); do
      xdotool mousemove "$x" "$y"
      sleep 0.12
      if begins "$name" "$text"; then
        sleep 0.3
        if begins "$name" "$text"; then return 0; fi
      fi
    done
  done
  fail "no place with $name $text"
}
pictures() { find "$folder" -maxdepth 1 -name 'hewn-*.png' | wc -l; }
has_pictures() { [ "$(pictures)" -ge "$1" ]; }
# take FILE: waits until nothing runs and the view is drawn in full, and keeps what is seen.
take() {
  local count
  until_true "rest before the picture $1" is_idle
  sleep 0.3
  count=$(pictures)
  key F12
  until_true "the picture $1" has_pictures $((count + 1))
  sleep 0.2
  mv "$(find "$folder" -maxdepth 1 -name 'hewn-*.png' | head -1)" "$1"
}
leave_view() { xdotool mousemove 640 787; }  # where nothing is hovered
# picture NAME: the same with the mouse out of the way, into the script's folder.
picture() {
  leave_view
  take "$folder/$1.png"
}
# open_window ARGUMENTS...
open_window() {
  : >"$folder/status.json"
  "$studio" "$@" --status "$folder/status.json" --pictures "$folder" --frame-stats \
    >"$folder/studio.txt" 2>&1 &
  pid=$!
  until_true "the window" xdotool search --name "Hewn Studio" >/dev/null
  until_true "its state" grep -q ready "$folder/status.json"
}
is_gone() { ! kill -0 "$pid" 2>/dev/null; }
is_gone_or_asks() { is_gone || is is_asking true; }
# Asked to close an unsaved plan, the window asks back; asked again, it closes.
close_window() {
  key ctrl+q
  within 100 is_gone_or_asks || true  # an exact picture without a graphics card takes seconds
  is_gone || key ctrl+q
  within 300 is_gone || true
  wait "$pid" || fail "the window ended with $?"
}
