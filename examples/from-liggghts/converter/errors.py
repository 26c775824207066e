# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""What stops the converter, and what leaves a line."""


class CannotConvert(Exception):
    """An error: no script is written."""


class Left(Exception):
    """A command that stays as a comment: why, what to do, and the nearest commands if they only wait to be taken."""

    def __init__(self, why, do, nearest=""):
        super().__init__(why)
        self.why, self.do, self.nearest = why, do, nearest
