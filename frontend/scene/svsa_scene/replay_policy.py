"""Content security policy of a replay's page; the server reads it without loading viser."""

REPLAY_POLICY = (
    "default-src 'none'; script-src 'unsafe-inline' 'unsafe-eval' data: blob:;"
    " style-src 'unsafe-inline'; img-src data: blob:; font-src data:; media-src data: blob:;"
    " connect-src data: blob:; worker-src data: blob:; frame-src 'self'; base-uri 'none';"
    " form-action 'none'"
)
