"""Files that the build has compressed: a client gets the best copy that it accepts."""

import os
from collections.abc import Mapping
from mimetypes import guess_type
from pathlib import Path
from typing import Any

from starlette.datastructures import Headers
from starlette.responses import FileResponse, Response
from starlette.staticfiles import NotModifiedResponse, StaticFiles
from starlette.types import Scope

from svsa_server.security_headers import POLICY

_SUFFIXES = {"br": ".br", "gzip": ".gz"}
"""Endings of the copies of `frontend/web/compress.mjs`, the smallest first."""


class CompressedFiles(StaticFiles):
    """A folder of files and their compressed copies.

    Args:
        headers: Headers of each answer.
        **options: As for `StaticFiles`; the folder may be missing.
    """

    def __init__(self, headers: Mapping[str, str], **options: Any) -> None:
        super().__init__(check_dir=False, **options)
        self._headers = headers

    async def check_config(self) -> None:
        """Accept a folder that does not exist: each request is answered with 404."""

    def file_response(
        self,
        full_path: "str | os.PathLike[str]",
        stat_result: os.stat_result,
        scope: Scope,
        status_code: int = 200,
    ) -> Response:
        """Return the copy in the best accepted encoding; each has an entity tag of its own."""
        request = Headers(scope=scope)
        path, headers = Path(full_path), dict(self._headers)
        media_type = guess_type(path.name)[0]
        accepted = list_accepted_encodings(request.get("accept-encoding", ""))
        for encoding, suffix in _SUFFIXES.items():
            copy = path.with_name(path.name + suffix)
            if encoding in accepted and copy.is_file():
                path, stat_result = copy, copy.stat()
                # `GZipMiddleware` adds `Vary` to the others.
                headers |= {"Content-Encoding": encoding, "Vary": "Accept-Encoding"}
                break
        response = FileResponse(path, status_code, headers, media_type, stat_result=stat_result)
        if self.is_not_modified(response.headers, request):
            unchanged = NotModifiedResponse(response.headers)
            # A browser applies the policy of this answer to its stored copy.
            unchanged.headers.update({k: v for k, v in headers.items() if k == POLICY})
            return unchanged
        return response


def list_accepted_encodings(header: str) -> set[str]:
    """List the encodings of an `Accept-Encoding` header that are not excluded by `q=0`."""
    accepted = set()
    for part in header.lower().split(","):
        name, _, weight = part.replace(" ", "").partition(";q=")
        if weight.strip("0.") or not weight:
            accepted.add(name)
    return accepted
