# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""What commands of the package share: their errors and exit codes are those of the program lsdcd."""
from __future__ import annotations

import argparse
import math
import os
import sys
from typing import Callable

from ._run_files import InputError


def above_zero(word: str) -> float:
    """A number of an option."""
    try:
        number = float(word)
    except ValueError:
        number = math.nan
    if not 0 < number < math.inf:
        raise argparse.ArgumentTypeError(f"'{word}' is no number above 0")
    return number


def run_command(name: str, options: argparse.ArgumentParser, run: Callable[[argparse.Namespace], None]) -> int:
    """Runs a command with the words of the command line. Returns its exit code: 0, 1 for what cannot be used, 2 for wrong words."""
    try:
        code = _run(name, options, run)
        sys.stdout.flush()
        return code
    except OSError as error:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())    # where Python writes the rest as it ends
        print(f"lsdcd: the standard output: {error.strerror}", file=sys.stderr)
        return 1


def _run(name: str, options: argparse.ArgumentParser, run: Callable[[argparse.Namespace], None]) -> int:
    try:
        run(options.parse_args())
    except SystemExit as ended:    # of argparse, which has said why
        return int(ended.code or 0)
    except InputError as error:
        print(f"lsdcd {name}: {error}", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        return 130
    return 0
