"""Reads a result.h5 as its users do and prints what it holds as JSON.

    read_result.py FILE GROUP...      exit 0: read; 1: the readers disagree or the file is not netCDF-4; 77: xarray is missing

Each GROUP is opened by xarray with both engines, which must agree in everything; netCDF4 and h5netcdf walk the whole
file besides. NaN is printed as null.
"""
import json
import math
import sys

try:
    import h5netcdf
    import netCDF4
    import numpy
    import xarray
except ImportError as missing:
    print(missing, file=sys.stderr)
    sys.exit(77)


def plain(value):
    """What json can print; arrays of one number (netCDF's attributes) become that number."""
    if isinstance(value, numpy.ndarray):
        return [plain(v) for v in value]
    if isinstance(value, numpy.generic):
        value = value.item()
    if isinstance(value, bytes):
        value = value.decode("utf-8")
    return None if isinstance(value, float) and math.isnan(value) else value


def read(path, group, engine):
    with xarray.open_dataset(path, group=group, engine=engine) as data:
        return {
            "dimensions": dict(data.sizes),
            "attributes": {k: plain(v) for k, v in data.attrs.items()},
            "variables": {
                name: {
                    "dimensions": list(v.dims),
                    "coordinate": name in data.coords,
                    "shape": list(v.shape),
                    "values": plain(v.values.reshape(-1)),
                    "kind": v.dtype.kind,
                    "attributes": {k: plain(a) for k, a in v.attrs.items()},
                    "fill": plain(v.encoding["_FillValue"]) if "_FillValue" in v.encoding else "none",
                }
                for name, v in sorted(data.variables.items())
            },
        }


def storage(group, into, prefix=""):
    """Every variable of the file by netCDF4: dimensions, type, and how it is stored."""
    for name, v in group.variables.items():
        filters = v.filters() or {}
        into[prefix + name] = {
            "dimensions": list(v.dimensions),
            "type": str(v.dtype),
            "zlib": bool(filters.get("zlib")),
            "complevel": int(filters.get("complevel", 0)),
            "shuffle": bool(filters.get("shuffle")),
            "chunking": v.chunking(),
            # netCDF takes a dimension of length 0 for one that has yet to grow.
            "unlimited": any(d.isunlimited() and d.size > 0 for d in v.get_dims()),
        }
        v[...]
    for name, child in group.groups.items():
        storage(child, into, prefix + name + "/")


def names(group, prefix=""):
    found = {prefix + v for v in group.variables}
    for name, child in group.groups.items():
        found |= names(child, prefix + name + "/")
    return found


def main(path, groups):
    out = {"groups": {}}
    for group in groups:
        one, other = (read(path, group, engine) for engine in ("netcdf4", "h5netcdf"))
        if json.dumps(one, sort_keys=True) != json.dumps(other, sort_keys=True):
            for name in sorted(set(one["variables"]) | set(other["variables"])):
                a, b = one["variables"].get(name), other["variables"].get(name)
                if a != b:
                    print(f"{group}/{name}: netcdf4 reads {a}, h5netcdf reads {b}", file=sys.stderr)
            print(f"{group}: the engines disagree: {one['dimensions']} {one['attributes']}, "
                  f"{other['dimensions']} {other['attributes']}", file=sys.stderr)
            return 1
        out["groups"][group] = one
    with netCDF4.Dataset(path) as file:
        if file.data_model != "NETCDF4":
            print(f"data model {file.data_model}", file=sys.stderr)
            return 1
        out["attributes"] = {k: plain(file.getncattr(k)) for k in file.ncattrs()}
        out["members"] = list(file.groups)
        out["storage"] = {}
        storage(file, out["storage"])
    with h5netcdf.File(path, "r") as file:
        if names(file) != set(out["storage"]):
            print(f"h5netcdf finds other variables: {names(file) ^ set(out['storage'])}", file=sys.stderr)
            return 1
    print(json.dumps(out, allow_nan=False))
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], sys.argv[2:]))
