"""Import of Python files by path, because another file of the same name is imported as well."""

import importlib.util


def module_of(path, name):
    """Runs the file and returns its module under a unique name: folders share names such as `dimensions`."""
    spec = importlib.util.spec_from_file_location(name, path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module
