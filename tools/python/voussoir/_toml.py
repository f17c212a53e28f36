"""Dictionaries as TOML texts."""

import math
import os
import re

_bare = re.compile(r"[A-Za-z0-9_-]+\Z")


def _key(name):
    return name if _bare.match(name) else _text(name)


def _text(value):
    escaped = value.replace("\\", "\\\\").replace('"', '\\"')
    return '"' + "".join(c if c >= " " and c != "\x7f" else f"\\u{ord(c):04x}" for c in escaped) + '"'


def _number(value):
    if math.isnan(value):
        return "nan"
    if math.isinf(value):
        return "inf" if value > 0 else "-inf"
    return repr(value)


def _value(value, place):
    if hasattr(value, "tolist"):  # of numpy: an array, or a number of its own kind
        value = value.tolist()
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, int):
        return str(value)
    if isinstance(value, float):
        return _number(value)
    if isinstance(value, str):
        return _text(value)
    if isinstance(value, os.PathLike):
        return _text(os.fspath(value))
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(_value(v, place) for v in value) + "]"
    if isinstance(value, dict):
        return "{" + ", ".join(f"{_key(k)} = {_value(v, f'{place}.{k}')}" for k, v in value.items()) + "}"
    raise TypeError(f"{place} is a {type(value).__name__}: a case holds numbers, texts, truth values, lists and "
                    "dictionaries of these.")


def _is_tables(value):
    return isinstance(value, (list, tuple)) and len(value) > 0 and all(isinstance(v, dict) for v in value)


def _table(table, name, lines):
    simple = {k: v for k, v in table.items() if not isinstance(v, dict) and not _is_tables(v)}
    for key, value in simple.items():
        if value is not None:  # a key with None is left out
            lines.append(f"{_key(key)} = {_value(value, name + key)}")
    for key, value in table.items():
        if isinstance(value, dict):
            lines.append(f"[{name}{_key(key)}]")
            _table(value, f"{name}{_key(key)}.", lines)
        elif _is_tables(value):
            for entry in value:
                lines.append(f"[[{name}{_key(key)}]]")
                _table(entry, f"{name}{_key(key)}.", lines)


def dumps(table):
    """The TOML text of a dictionary; keys whose value is None are left out."""
    lines = []
    _table(table, "", lines)
    return "\n".join(lines) + "\n"
