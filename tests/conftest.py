# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""What all tests in Python share. CTest starts each as tests/CMakeLists.txt says; by hand, with its environment:

  ctest --test-dir build -R '^lammps.test_servo$' -V
"""
import pathlib
import shutil
import tempfile

import pytest

import facts

SKIPPED = 77    # what CTest takes for a test that could not run


@pytest.fixture(scope="module")
def folder(request):
    """A folder, which stays if one of the module's tests fails. A function of the module of the name prepare is called with it first,
    and writes the files that all tests need."""
    made = pathlib.Path(tempfile.mkdtemp(prefix="lsdcd-"))
    before = request.session.testsfailed
    getattr(request.module, "prepare", lambda folder: None)(made)
    yield made
    if request.session.testsfailed == before:
        shutil.rmtree(made)
    else:
        print("files are in", made)


@pytest.hookimpl(tryfirst=True)
def pytest_pyfunc_call(pyfuncitem):
    """Calls a test, which fails if one of its facts does not hold."""
    facts.failed.clear()
    names = pyfuncitem._fixtureinfo.argnames
    pyfuncitem.obj(**{name: pyfuncitem.funcargs[name] for name in names})
    if facts.failed:
        pytest.fail(f"{len(facts.failed)} facts do not hold:\n  " + "\n  ".join(facts.failed), pytrace=False)
    return True


def pytest_sessionfinish(session, exitstatus):
    reports = session.config.pluginmanager.get_plugin("terminalreporter").stats
    if exitstatus in (0, pytest.ExitCode.NO_TESTS_COLLECTED) and reports.get("skipped") and not reports.get("passed"):
        session.exitstatus = SKIPPED
