"""Why the compiled module cannot be imported."""

import os
import sys
import sysconfig


def why_not(error):
    """A text that says what is wrong and what to do."""
    folder = os.path.dirname(os.path.abspath(__file__))
    modules = [name for name in os.listdir(folder) if name.startswith("_voussoir.") and name.endswith(".so")]
    ours = f"_voussoir.{sysconfig.get_config_var('SOABI')}.so"
    if not modules:
        return (f"{folder} holds no compiled module {ours}: build it (cmake --build BUILD --target voussoir_python, then "
                "PYTHONPATH=BUILD/python), or install python3-voussoir or a wheel.")
    if ours not in modules:
        version = f"{sys.version_info[0]}.{sys.version_info[1]}"
        return (f"voussoir was compiled for another Python ({', '.join(modules)}), and this is Python {version} "
                f"({sys.executable}): run that Python, or install voussoir again with this one (pip install .).")
    if "cannot open shared object file" in str(error):
        return (f"a library that voussoir needs is not installed: {error}. On Debian 12, tools/install-packages or the "
                "package python3-voussoir installs it.")
    return f"the compiled module of voussoir cannot be loaded: {error}."
