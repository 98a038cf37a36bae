"""Verification of the signed token of a launch (LTI 1.3 core, 5.1.3 and 5.3)."""

from typing import Any, Literal, NamedTuple

from joserfc import jwt
from joserfc.errors import JoseError
from joserfc.jwk import KeySet

from svsa_server.lti.launch_error import LaunchError
from svsa_server.lti.platforms import Platform, check_address

_CLAIM = "https://purl.imsglobal.org/spec/lti/claim/"
_GRADES = "https://purl.imsglobal.org/spec/lti-ags/claim/endpoint"
SCORE_SCOPE = "https://purl.imsglobal.org/spec/lti-ags/scope/score"
_ROLES = "http://purl.imsglobal.org/vocab/lis/v2/membership#"
LEEWAY_S = 60
_LONGEST_NAME = 60


class Launch(NamedTuple):
    """A launch.

    Attributes:
        user: Id at the platform.
        name: Name of the user.
        role: Role of the user.
        target: Requested address.
        exercise: Exercise from its custom parameter.
        line_item: Address for its grades, if any.
    """

    user: str
    name: str
    role: Literal["student", "instructor"]
    target: str
    exercise: str
    line_item: str | None


def read_launch(platform: Platform, keys: KeySet, token: str, nonce: str) -> Launch:
    """Verify the token of a launch.

    Raises:
        LaunchError: If it is invalid, with the reason.
    """
    try:
        # The algorithm is fixed: the header of a token must not choose how it is verified.
        claims = jwt.decode(token, keys, algorithms=["RS256"]).claims
        needed = jwt.JWTClaimsRegistry(
            leeway=LEEWAY_S,
            iss={"essential": True, "value": platform.issuer},
            aud={"essential": True, "value": platform.client_id},
            exp={"essential": True},
            iat={"essential": True},
            nonce={"essential": True, "value": nonce},
        )
        needed.validate(claims)
    except (JoseError, ValueError, TypeError, KeyError) as error:
        raise LaunchError(f"The platform's token is invalid: {error}") from None
    audience = claims["aud"]
    if isinstance(audience, list) and len(audience) > 1:
        _check(claims, "azp", (platform.client_id,))
    _check(claims, f"{_CLAIM}message_type", ("LtiResourceLinkRequest",))
    _check(claims, f"{_CLAIM}version", ("1.3.0",))
    _check(claims, f"{_CLAIM}deployment_id", platform.deployments)
    user = claims.get("sub")
    if not isinstance(user, str) or not 0 < len(user) <= 255:
        raise LaunchError("The platform does not send the id of the user (sub): enable it there.")
    custom = _read_table(claims, f"{_CLAIM}custom")
    return Launch(
        user,
        _read_name(claims),
        _read_role(claims, platform),
        str(claims.get(f"{_CLAIM}target_link_uri") or ""),
        str(custom.get("exercise") or ""),
        _read_line_item(claims),
    )


def _check(claims: dict[str, Any], name: str, allowed: tuple[str, ...]) -> None:
    value = claims.get(name)
    if value not in allowed:
        word = name.rpartition("/")[2]
        raise LaunchError(f"{word} is {value!r:.100}: it must be {' or '.join(allowed)}.")


def _read_table(claims: dict[str, Any], name: str) -> dict[str, Any]:
    table = claims.get(name)
    return table if isinstance(table, dict) else {}


def _read_name(claims: dict[str, Any]) -> str:
    name = claims.get("name") or claims.get("given_name") or ""
    printable = "".join(character for character in str(name) if character.isprintable()).strip()
    return printable[:_LONGEST_NAME] or "Student"


def _read_role(claims: dict[str, Any], platform: Platform) -> Literal["student", "instructor"]:
    roles = claims.get(f"{_CLAIM}roles")
    is_instructor = isinstance(roles, list) and f"{_ROLES}Instructor" in roles
    return "instructor" if is_instructor and platform.takes_instructors else "student"


def _read_line_item(claims: dict[str, Any]) -> str | None:
    grades = _read_table(claims, _GRADES)
    item, scopes = grades.get("lineitem"), grades.get("scope")
    if not isinstance(item, str) or not isinstance(scopes, list) or SCORE_SCOPE not in scopes:
        return None
    try:
        return check_address(item)
    except ValueError:
        return None
