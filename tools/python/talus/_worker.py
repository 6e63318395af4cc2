"""A run of a sweep: arguments of talus.run() on standard input, (result, error) on standard output, both pickled."""

import os
import pickle
import signal
import sys

from ._run import simulate


def main():
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the sweep gets the signal, and ends its processes
    output = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)  # what anything prints is no result
    arguments = pickle.load(sys.stdin.buffer)
    try:
        outcome = simulate(**arguments), None
    except Exception as error:  # for the list of the sweep
        outcome = None, error
    with output:
        pickle.dump(outcome, output)


main()
