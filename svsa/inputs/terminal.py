"""Exit code of an interruption; output on terminals that lack Greek letters and signs."""

import codecs
import sys
import unicodedata

INTERRUPTED = 130
"""Exit code of a command that was ended by Ctrl-C."""
HANDLER = "svsa.spell"
_SIGNS = {
    **{"−": "-", "–": "-", "—": "-", "‑": "-", "·": "*", "×": "x", "±": "+-", "∫": "integral "},
    **{"≤": "<=", "≥": ">=", "≈": "~", "→": "->", "←": "<-", "…": "...", "°": " deg", "✓": "yes"},
}


def spell_missing_characters() -> None:
    """Write characters that the encoding of stdout and stderr lacks in letters, such as sigma.

    Otherwise one σ in a help text ends a command with `UnicodeEncodeError`, as in cp1252 or ASCII.
    """
    codecs.register_error(HANDLER, _spell_all)
    for stream in (sys.stdout, sys.stderr):
        # A test or a window may have replaced the stream by one without an encoding.
        if reconfigure := getattr(stream, "reconfigure", None):
            reconfigure(errors=HANDLER)


def _spell_all(error: UnicodeError) -> tuple[str, int]:
    if not isinstance(error, UnicodeEncodeError):
        raise error
    return "".join(map(_spell, error.object[error.start : error.end])), error.end


def _spell(character: str) -> str:
    if sign := _SIGNS.get(character):
        return sign
    # A letter without its accents, then the name of a Greek letter.
    plain = unicodedata.normalize("NFKD", character)[0]
    if plain.isascii():
        return plain
    kind, _, name = unicodedata.name(plain, "").partition(" LETTER ")
    if not kind.startswith("GREEK"):
        return "?"
    return name.split()[0].lower() if "SMALL" in kind else name.split()[0].capitalize()
