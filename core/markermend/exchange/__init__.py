"""Takes in the containers of other libraries: xarray, pandas, ezc3d, Kinetics Toolkit.

Nothing here is needed to read, repair or write takes; xarray and pandas come with the extra
``tables``: ``pip install "markermend[tables]"``.
"""

from markermend.exchange.frames import to_dataframe
from markermend.exchange.memory import from_ezc3d, from_kineticstoolkit
from markermend.exchange.xarrays import from_xarray, to_xarray

__all__ = ["from_ezc3d", "from_kineticstoolkit", "from_xarray", "to_dataframe", "to_xarray"]
