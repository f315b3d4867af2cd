"""Python files that are read by their path, because another file of the same name is imported as well."""

import importlib.util


def module_of(path, name):
    """Runs the file and answers its module, which has a name of its own: folders share names such as `dimensions`."""
    spec = importlib.util.spec_from_file_location(name, path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module
