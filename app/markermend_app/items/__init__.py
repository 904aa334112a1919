"""Items drawn inside pyqtgraph plots."""
