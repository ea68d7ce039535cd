"""What users give, as the compiled part takes it."""

import json
import os
from collections.abc import Mapping
from operator import index

import numpy as np

from . import _core


def text_of(value):
    """A mapping, list or number as JSON, which is YAML; NumPy values included."""

    def plain(other):
        if isinstance(other, (np.ndarray, np.generic)):
            return other.tolist()
        if isinstance(other, Mapping):
            return dict(other)
        raise TypeError(f"{type(other).__name__} cannot be part of a dataset or scenario")

    # YAML reads no pairs of surrogates.
    return json.dumps(value, default=plain, allow_nan=False, ensure_ascii=False, indent=1)


def dataset_source(dataset):
    """A folder's path, or a mapping laid out like dataset.yaml whose trials have a ``trace``."""
    if not isinstance(dataset, Mapping):
        return _core.DatasetSource(os.fspath(dataset), "", {})
    document = dict(dataset)
    trials, traces = [], {}
    for number, trial in enumerate(document.get("trials", ()), start=1):
        trial = dict(trial)
        name = trial.setdefault("file", f"trial-{number}.csv")
        if "trace" in trial:
            traces[name] = dict(trial.pop("trace"))
        trials.append(trial)
    document["trials"] = trials
    return _core.DatasetSource("", text_of(document), traces)


def words(value):
    """One name or several, as a list."""
    return [value] if isinstance(value, str) else list(value)


def numbers(values):
    return {name: float(value) for name, value in dict(values or {}).items()}


def jobs_of(jobs):
    return index(jobs) if jobs is not None else os.cpu_count() or 1


def problem_options(law, free, fix, with_, keep_stray, integrator, tolerance):
    return {
        "law": law or "",
        "free": words(free),
        "fix": numbers(fix),
        "with_": words(with_),
        "keep_stray": bool(keep_stray),
        "integrator": integrator,
        "tolerance": float(tolerance),
    }


def search_options(starts, seed, strategy, span, loss, loss_scale, discrepancy, jobs):
    return {
        "starts": index(starts),
        "seed": index(seed),
        "strategy": strategy,
        "span": span,
        "loss": loss,
        "loss_scale": float(loss_scale),
        "discrepancy": discrepancy,
        "jobs": jobs_of(jobs),
    }
