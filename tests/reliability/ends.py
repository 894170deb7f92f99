"""How a program may end that got something from elsewhere: with the right answer, or with a refusal in words.
Never by a signal, with an internal error, without an end, or with all of the memory."""
import collections
import contextlib
import os
import pathlib
import resource
import select
import signal
import subprocess
import tempfile

from programs import PATIENCE, SWARMSMITH, send
from rig import SANITIZED

#: What no refusal says.
BROKEN = ("internal error", "terminate called", "Traceback", "std::", "Sanitizer")
#: Exit codes of refusals (docs/command-line.md).
REFUSALS = (1, 2, 3, 4, 5, 6)
#: So much address space (bytes), so that what takes all memory harms no other program.
MOST_SPACE = 4 << 30

#: Exit code (negative: a signal), both outputs, seconds of processor time, and the most memory in MiB; of the process
#: and all that it started and waited for.
End = collections.namedtuple("End", "words code out err processor memory hung")


def end_of(*words, processor=60, seconds=600, env=None, cwd=None):
    """swarmsmith with these words, to its end. It is ended after so many seconds of processor time, and also after so many
    by the clock."""
    with tempfile.TemporaryFile() as out, tempfile.TemporaryFile() as err:
        process = subprocess.Popen([SWARMSMITH, *map(str, words)], stdin=subprocess.DEVNULL, stdout=out, stderr=err,
                                   start_new_session=True, cwd=cwd, env={**os.environ, **(env or {})})
        limits = {resource.RLIMIT_CPU: processor * PATIENCE}
        if not SANITIZED:
            limits[resource.RLIMIT_AS] = MOST_SPACE
        for what, most in limits.items():
            with contextlib.suppress(ProcessLookupError):  # it is over already
                resource.prlimit(process.pid, what, (most, most))
        watch = os.pidfd_open(process.pid)
        hung = not select.select([watch], [], [], seconds * PATIENCE)[0]
        os.close(watch)
        if hung:
            send(-process.pid, signal.SIGKILL)
        _, status, used = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        texts = []
        for file in (out, err):
            file.seek(0)
            texts.append(file.read(1 << 24).decode(errors="replace"))
    return End(words, process.returncode, *texts, used.ru_utime + used.ru_stime, used.ru_maxrss / 1024, hung)


def what_is_wrong_with(end):
    """A sentence about an end that is neither an answer nor a refusal; empty for any other."""
    said = end.err.strip() or end.out.strip()
    name = " ".join(pathlib.Path(str(word)).name for word in end.words)[:120]
    if end.hung:
        return f"`{name}` has no end"
    if end.code == -signal.SIGKILL:  # what the limit of processor time ends with
        return f"`{name}` took {end.processor:.0f} s of processor time and had no end"
    if end.code < 0:
        return f"`{name}` was ended by signal {-end.code}: {said[-300:]}"
    for word in BROKEN:
        if word in end.err:
            return f"`{name}` says `{word}`: {said[-300:]}"
    if end.code == 0:
        return ""
    if end.code not in REFUSALS:
        return f"`{name}` ended with {end.code}: {said[-300:]}"
    # `verify` and `status` answer on standard output what they have found.
    if len(said.splitlines()[0] if said else "") < 30:
        return f"`{name}` ended with {end.code} and no sentence: {said!r}"
    return ""
