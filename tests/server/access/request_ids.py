"""Every text in a request that could be an id, found in the OpenAPI schema."""

import copy
from collections.abc import Iterator
from typing import Any, NamedTuple

from tests.server.routes.writing import list_examples

ANY_ITEM = "[]"
ANY_KEY = "{}"
Path = tuple[str, ...]
Variant = tuple[tuple[str, str], ...]


class Place(NamedTuple):
    """A text in a request.

    place: path, query, header or body. keys: names on the path to the text, `[]` for an item of a
    list and `{}` for the key of a mapping. owned: the kind of object that it names, if it is
    marked. variant: the constants of the kind of body that contains it, such as `from`: `run`.
    """

    method: str
    route: str
    place: str
    keys: Path
    owned: str | None
    variant: Variant = ()

    @property
    def operation(self) -> str:
        """Return METHOD and path."""
        return f"{self.method} {self.route}"

    @property
    def label(self) -> str:
        """Return the name in the tables of exceptions."""
        return f"{self.operation} {self.place}:{'.'.join(self.keys)}"

    @property
    def name(self) -> str:
        """Return the name that describes the text."""
        named = (key for key in reversed(self.keys) if key not in (ANY_ITEM, ANY_KEY))
        return next(named, self.place)


def list_places(schema: dict[str, Any]) -> Iterator[Place]:
    """Return every place in every request for a free text, or a number that may be an id."""
    for route, item in schema["paths"].items():
        for method, operation in item.items():
            for one in operation.get("parameters", ()):
                start = (method.upper(), route, one["in"], (one["name"],))
                yield from _walk(schema, one["schema"], *start)
            for content in operation.get("requestBody", {}).get("content", {}).values():
                yield from _walk(schema, content["schema"], method.upper(), route, "body", ())


def _walk(
    schema: dict[str, Any], part: Any, method: str, route: str, place: str, keys: Path
) -> Iterator[Place]:
    for variant, kind in _list_variants(schema, part):
        found: dict[Path, str | None] = {}
        for one, owned in _list_texts(schema, kind, keys, frozenset(), place == "path"):
            found[one] = owned if one not in found else found[one] and owned
        for one, owned in found.items():
            yield Place(method, route, place, one, owned, variant)


def _list_variants(schema: dict[str, Any], part: Any) -> Iterator[tuple[Variant, Any]]:
    """Return each variant of a body with several, with the constants that identify it."""
    while "$ref" in part:
        part = schema["components"]["schemas"][part["$ref"].rpartition("/")[2]]
    if "discriminator" in part:
        for one in part["oneOf"]:
            yield from _list_variants(schema, one)
    else:
        fields = part.get("properties", {})
        yield tuple((n, one["const"]) for n, one in fields.items() if "const" in one), part


def _list_texts(
    schema: dict[str, Any], part: Any, keys: Path, seen: frozenset[str], takes_numbers: bool
) -> Iterator[tuple[Path, str | None]]:
    """Yield keys and mark of each text in this part of the schema."""
    if "$ref" in part:
        name = part["$ref"].rpartition("/")[2]
        if name not in seen:
            inner = schema["components"]["schemas"][name]
            yield from _list_texts(schema, inner, keys, seen | {name}, takes_numbers)
        return
    for word in ("anyOf", "oneOf", "allOf"):
        for one in part.get(word, ()):
            yield from _list_texts(schema, one, keys, seen, takes_numbers)
    if part.get("type") == "string" and not part.keys() & {"enum", "const"}:
        yield keys, part.get("x-owned")
    if part.get("type") == "integer" and (takes_numbers or keys[-1].endswith(("id", "ids"))):
        yield keys, part.get("x-owned")
    for name, one in part.get("properties", {}).items():
        yield from _list_texts(schema, one, (*keys, name), seen, takes_numbers)
    if isinstance(items := part.get("items"), dict):
        yield from _list_texts(schema, items, (*keys, ANY_ITEM), seen, takes_numbers)
    if values := part.get("additionalProperties"):
        yield (*keys, ANY_KEY), None
        if isinstance(values, dict):
            yield from _list_texts(schema, values, (*keys, ANY_KEY), seen, takes_numbers)


class Asked(NamedTuple):
    """The arguments of a request for httpx."""

    method: str
    path: str
    query: dict[str, Any]
    body: Any


def build_request(schema: dict[str, Any], place: Place, value: str, known: dict[str, str]) -> Asked:
    """A valid request with this value at that place.

    known: ids for the other places, by kind; texts without a mark are those of the schema's
    examples.
    """
    operation = schema["paths"][place.route][place.method.lower()]
    path, query = place.route, {}
    for one in operation.get("parameters", ()):
        is_meant = (one["in"], one["name"]) == (place.place, *place.keys[:1])
        inner = one["schema"].get("items", one["schema"])
        given: Any = value if is_meant else known.get(inner.get("x-owned", ""))
        given = given or _find_example(one)
        if one["in"] == "path":
            path = path.replace(f"{{{one['name']}}}", str(given))
        elif one["in"] == "query" and (is_meant or one.get("required")):
            query[one["name"]] = given
    body = _choose_example(operation, place.variant) if "requestBody" in operation else None
    if place.place == "body":
        body = _set(body, place.keys, value)
    return Asked(place.method, path, query, body)


def _choose_example(operation: dict[str, Any], variant: Variant) -> Any:
    """Return the first example of this variant of the body."""
    examples = list_examples(operation)
    fitting = [
        one
        for one in examples
        if isinstance(one, dict) and all(one.get(k) == v for k, v in variant)
    ]
    return copy.deepcopy((fitting or examples)[0])


def _find_example(parameter: dict[str, Any]) -> Any:
    inner = parameter["schema"]
    found = parameter.get("examples") or inner.get("examples") or inner.get("enum")
    return found[0] if found else 1 if inner.get("type") == "integer" else "x"


def _set(body: Any, keys: Path, value: str) -> Any:
    """Set this value in the body at its keys; lists there have one item."""
    if not keys:
        return value
    if keys[0] == ANY_ITEM:
        return [_set(body[0] if body else None, keys[1:], value)]
    return (body or {}) | {keys[0]: _set((body or {}).get(keys[0]), keys[1:], value)}
