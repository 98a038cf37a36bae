"""The file of platforms: disabled without it, and rejected with the reason if it is invalid."""

import pytest

from svsa.errors import ParameterError
from svsa_server.lti.platforms import read_lti_file
from tests.lab_in_process import run_lab_in_process
from tests.server.lti.platform import DEPLOYMENT, run_platform


def test_launches_are_disabled_without_a_file():
    with run_lab_in_process(classroom="true") as lab:
        assert lab.client.get("/lti/keys").status_code == 404
        assert lab.client.get("/lti/login").status_code == 404
        assert lab.client.post("/lti/launch", data={"state": "x"}).status_code == 404


def test_invalid_file_or_missing_class_is_rejected_with_reason(tmp_path):
    with run_platform() as platform:
        path, url = platform.write_settings(tmp_path), platform.url
    right = path.read_text()
    for wrong, reported in (
        (right.replace(f"{url}/keys", "http://elsewhere.example.org/keys"), "keyset_url"),
        (right.replace('deployments = ["1"]', "deployments = []"), "deployments"),
        (right + right[right.index("[[platforms]]") :], "once"),
        ("key_file = 'a.pem'", "platforms"),
    ):
        path.write_text(wrong)
        with pytest.raises(ParameterError, match=reported):
            read_lti_file(path)
    path.write_text(right)
    assert read_lti_file(path).platforms[0].deployments == (DEPLOYMENT,)
    with pytest.raises(ParameterError, match="--class"), run_lab_in_process(lti=str(path)):
        pass
