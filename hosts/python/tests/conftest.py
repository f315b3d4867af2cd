"""Skips tests that import what the platform has no package of: PONG_TESTS_LACK lists it (ci/foreign_python_tests)."""

import os
import sys

import pytest


class Lacking:
    """Finds every module of that list, and skips the test, or the file of tests, that imports it."""

    names = set(os.environ.get("PONG_TESTS_LACK", "").split())

    @classmethod
    def find_spec(cls, name, path=None, target=None):
        if name.partition(".")[0] in cls.names:
            raise pytest.skip.Exception(f"there is no {name.partition('.')[0]} here", allow_module_level=True)


sys.meta_path.insert(0, Lacking)
