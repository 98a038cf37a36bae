# Functions for a lab that a script starts in the background.

# Print the address that the lab wrote to a log. Arguments: log, process id.
wait_for_address() {
  local address
  for _ in $(seq 3600); do
    address=$(grep -om1 'http://127\.0\.0\.1:[0-9]*' "$1" || true)
    [ -z "$address" ] || { echo "$address"; return; }
    kill -0 "$2" 2>/dev/null || break
    sleep 0.5
  done
  echo "The lab did not start:" >&2
  cat "$1" >&2
  return 1
}

# Fetch paths, each of which must answer with 200. Arguments: Python, address, paths.
fetch() {
  "$1" - "${@:2}" <<'PY'
import sys
import urllib.request

lab = urllib.request.build_opener(urllib.request.ProxyHandler({}))
for path in sys.argv[2:]:
    with lab.open(sys.argv[1] + path, timeout=60) as answer:
        print(answer.status, path)
PY
}
