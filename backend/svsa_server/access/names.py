"""Names of people: which may be chosen, and which would be mistaken for another.

Two names are the same if they differ by case, spaces, Unicode forms or look-alike letters only
(Unicode Technical Standard 39, with the tables of confusable-homoglyphs).
"""

import re
import unicodedata
from contextlib import suppress
from functools import cache
from string import ascii_lowercase

from confusable_homoglyphs.utils import load

MAX_MARKS = 3
_TABLE = "confusables.json"
_FORMULA = "=+-@"
# Characters that are printable according to Python and show nothing.
_INVISIBLE = re.compile(
    "[\u034f\u115f\u1160\u17b4\u17b5\u180b-\u180f\u2800\u3164\ufe00-\ufe0f\uffa0"
    "\U000e0100-\U000e01ef]"
)
_SPACES = re.compile("[ \u00a0\u1680\u2000-\u200a\u202f\u205f\u3000]+")
_WORD = re.compile(r"[^\W_]+")
_NUMBERS = re.compile(r"\b\d+|\d+\b")
_ID = re.compile(r"p[0-9a-fol]{12,24}")
"""The key of an id: 0 and 1 look like letters."""
_WORDS = """
    instructor teacher lecturer professor prof tutor moderator supervisor staff observer operator
    student lab svsa svsalab laboratory system server admin administrator root superuser owner
    host bench shared script user anonymous everyone unknown none null
    undefined you me stranger notsignedin
    dozent dozentin lehrer lehrerin betreuer betreuerin tutorin professorin studentin beobachter
    professeur professeure enseignant enseignante instructeur instructrice formateur formatrice
    administrateur étudiant observateur opérateur système
    profesor profesora instructora maestro maestra docente administrador estudiante sistema
    istruttore istruttrice insegnante professore professoressa amministratore studente
    professora instrutor instrutora administradora aluno docent docente leraar lerares beheerder
    instruktor nauczyciel wykładowca profesorka učitel učitelka vyučující správce lärare instruktör
    underviser lærer instruktør opettaja ohjaaja oktató tanár rendszergazda öğretmen eğitmen
    öğretimgörevlisi yönetici giảngviên giáoviên
    преподаватель инструктор учитель профессор администратор система студент викладач інструктор
    καθηγητής εκπαιδευτής διαχειριστής 老师 教师 讲师 教授 管理员 系统 导师 老師 教師 講師 管理員
    系統 導師 先生 管理者 システム インストラクター 강사 교수 교수님 선생님 교사 관리자 시스템
    مدرب أستاذ معلم مدرس مدير מדריך מורה מרצה מנהל प्रशिक्षक शिक्षक अध्यापक
"""
_WORDS_IN_NAMES = "instructor admin administrator moderator system"
"""Also rejected as one word of a longer name, such as "The Instructor"."""


def clean_name(name: str) -> str:
    """Return the name with single spaces, in composed form (NFC).

    Args:
        name: Name that a person enters.

    Raises:
        ValueError: If it cannot be read, or would be mistaken for a role, an id or a formula.
    """
    name = _SPACES.sub(" ", unicodedata.normalize("NFC", name)).strip(" ")
    if not name.isprintable() or _INVISIBLE.search(name):
        raise ValueError("a text without invisible or control characters")
    if not any(unicodedata.category(letter)[0] in "LN" for letter in name):
        raise ValueError("a text with at least one letter or digit")
    if _has_stack(name):
        raise ValueError(f"a text with at most {MAX_MARKS} marks on a letter")
    if unicodedata.normalize("NFKC", name)[0] in _FORMULA:
        raise ValueError(f"a text that does not begin with one of {' '.join(_FORMULA)}")
    if is_reserved(name):
        raise ValueError("a name that does not stand for a role, the lab or an id")
    return name


def is_reserved(name: str) -> bool:
    """Return whether a name is that of a role, of the lab or an id."""
    whole, inside = _list_reserved()
    for text in (name, _NUMBERS.sub("", name.replace("_", " "))):
        for words in _list_words(text):
            joined = "".join(words)
            if joined in whole or _ID.fullmatch(joined) or not inside.isdisjoint(words):
                return True
    return False


def list_keys(name: str) -> frozenset[str]:
    """Return the keys of a name: two names look alike if they share one.

    One key folds the case before the letters, the others after: a capital `I` looks like `l`, a
    small one does not. NFKC makes a sigma of a letter that looks like `C`.
    """
    name = " ".join(name.split())
    normal = " ".join(unicodedata.normalize("NFKC", name).split())
    return frozenset(_fold(spelling) for spelling in (name, normal, normal.casefold()))


def _list_words(text: str) -> list[list[str]]:
    """List the words of each key of a text: of letters, and of what looks like them, unmarked."""
    return [_WORD.findall(_strip_marks(key)) for key in list_keys(text)]


def _fold(name: str) -> str:
    decomposed = unicodedata.normalize("NFD", name)
    alike = decomposed.translate(_read_prototypes())
    return unicodedata.normalize("NFD", alike).casefold()


def _strip_marks(name: str) -> str:
    decomposed = unicodedata.normalize("NFD", name)
    return "".join(letter for letter in decomposed if unicodedata.category(letter)[0] != "M")


def _has_stack(name: str) -> bool:
    count = 0
    for letter in name:
        count = count + 1 if unicodedata.category(letter) in ("Mn", "Me") else 0
        if count > MAX_MARKS:
            return True
    return False


@cache
def _list_reserved() -> tuple[frozenset[str], frozenset[str]]:
    """List the keys of reserved names, and of words that are reserved within a name."""
    whole, inside = (
        frozenset(
            "".join(listed)
            for word in words.split()
            # A capital `I` has other look-alikes than a small one.
            for form in (word, word.capitalize(), word.upper(), word.replace("i", "I"))
            for listed in _list_words(form)
        )
        for words in (_WORDS, _WORDS_IN_NAMES)
    )
    return whole, inside


@cache
def _read_prototypes() -> dict[int, str]:
    """The letter or letters that each character looks like.

    The package's table is symmetric: a prototype lists all characters that look like it, and each
    of those lists the prototype only.
    """
    table = {key.strip("\u200e"): value for key, value in load(_TABLE).items()}
    prototypes = {}
    for letter, alike in table.items():
        if len(letter) > 1 or len(alike) > 1:
            continue
        other = alike[0]["c"].strip("\u200e")
        is_pair = len(table.get(other, ())) == 1
        prototypes[ord(letter)] = min(letter, other) if is_pair else other
    for letter in ascii_lowercase:
        with suppress(KeyError):
            small_capital = unicodedata.lookup(f"LATIN LETTER SMALL CAPITAL {letter}")
            prototypes[ord(small_capital)] = prototypes.get(ord(letter), letter)
    return prototypes
