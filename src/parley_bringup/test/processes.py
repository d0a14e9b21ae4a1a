# SPDX-License-Identifier: BSD-3-Clause
"""Processes that end with the test that started them, whatever becomes of it."""
import contextlib
import ctypes
import os
import signal
import subprocess

PR_SET_PDEATHSIG = 1
PATIENCE = 30.0   # [s] for roslaunch to end its nodes


def interrupt(*_):
    raise KeyboardInterrupt


def follow_parent():
    """SIGINT when whoever started this process is gone, also where it was started with SIGINT ignored, as in the background."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    ctypes.CDLL(None).prctl(PR_SET_PDEATHSIG, signal.SIGINT)


def end_with_parent():
    """For a test: it tidies up as well when it is asked to end, or when the one that runs it is killed."""
    follow_parent()
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, interrupt)


def descendants(pid):
    """The processes below one; roslaunch puts each node into a process group of its own."""
    try:
        with open(f'/proc/{pid}/task/{pid}/children', encoding='ascii') as file:
            children = [int(word) for word in file.read().split()]
    except OSError:
        return []
    return children + [below for child in children for below in descendants(child)]


class Processes:
    """Ends all that it started when it is closed."""

    def __init__(self):
        self.started = []

    def __enter__(self):
        return self

    def start(self, command, **options):
        process = subprocess.Popen(command, preexec_fn=follow_parent, **options)
        self.started.append(process)
        return process

    def __exit__(self, *_):
        """Asks all, waits for each, and kills what is left with all below it."""
        below = [pid for process in self.started for pid in descendants(process.pid)]
        for process in self.started:
            if process.poll() is None:
                process.send_signal(signal.SIGINT)
        for process in self.started:
            try:
                process.wait(PATIENCE)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()
        for pid in below:
            with contextlib.suppress(ProcessLookupError):
                os.kill(pid, signal.SIGKILL)
        for process in self.started:
            for stream in filter(None, (process.stdin, process.stdout)):
                stream.close()
