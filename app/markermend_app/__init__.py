"""The desktop application: it shows a session and holds no science."""

from markermend_app.lazy_qt import import_pyqtgraph

import_pyqtgraph()
