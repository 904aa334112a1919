"""``python -m markermend``: the command line, where no ``markermend`` program is on the path."""

import sys

from markermend.cli import main

if __name__ == "__main__":
    sys.exit(main())
