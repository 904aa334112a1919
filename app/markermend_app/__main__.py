"""``python -m markermend_app [TAKE]``."""

import sys

from markermend_app.main import main

sys.exit(main())
