# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""What fix wall/lsdcd says of many walls, in one run of LAMMPS. A script calls refusals() by LAMMPS's command python. The folder has walls.json, a list of
the words behind wall/lsdcd, and gets said.json, a list with the error of each, or null. Standard library only, as LAMMPS's Python has no more."""
import ctypes
import json
import os
import re
import signal

SCRIPT = "python refusals input 1 SELF format p file {}\npython refusals invoke\n"


def error_of(me, words):
    """In a process that is a copy of this one, and is killed once it has said its error: MPI, which it would leave, is not its own."""
    c = ctypes.CDLL(None)
    c.fflush(None)
    read, write = os.pipe()
    child = os.fork()
    if child == 0:
        os.close(read)
        for stream in (1, 2):
            os.dup2(write, stream)
        c.setvbuf(ctypes.c_void_p.in_dll(c, "stdout"), None, 2, 0)    # _IONBF: an error is there before LAMMPS leaves MPI
        c.lammps_command(me, f"fix wall all wall/lsdcd {words}".encode())
        c.fflush(None)
        os._exit(0)
    os.close(write)
    said, found = b"", None
    while not found:
        more = os.read(read, 65536)
        if not more:
            break
        said += more
        found = re.search(rb"^ERROR.*\n", said, re.M)
    os.close(read)
    os.kill(child, signal.SIGKILL)
    status = os.waitpid(child, 0)[1]
    if not found and status not in (0, signal.SIGKILL):
        return f"ended with the status {status}: {said.decode()}"
    return found and found[0].decode()


def refusals(capsule):
    pointer_of = ctypes.pythonapi.PyCapsule_GetPointer
    pointer_of.restype, pointer_of.argtypes = ctypes.c_void_p, (ctypes.py_object, ctypes.c_char_p)
    me = ctypes.c_void_p(pointer_of(capsule, None))
    with open("walls.json", encoding="utf-8") as walls:
        said = [error_of(me, words) for words in json.load(walls)]
    with open("said.json", "w", encoding="utf-8") as to:
        json.dump(said, to)
