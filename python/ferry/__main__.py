"""``python -m ferry`` is the command ``ferry``."""

import signal
import sys

from ferry._ferry import run


def main() -> int:
    # The native code runs until its end; Python's own handler would only note an interrupt.
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    try:
        return run(["ferry", *sys.argv[1:]])
    except RuntimeError as error:
        print(f"ferry: {error}", file=sys.stderr)
        return 1


if __name__ == "__main__":
    sys.exit(main())
