"""An analysis as JSON types."""

from __future__ import annotations

from typing import Any

from swarmdsl.execution.estimation.intervals import Interval
from swarmdsl.execution.estimation.sample import Sample
from swarmdsl.execution.experiments.designs.factors import Value
from swarmdsl.execution.experiments.effects import Effect, Effects
from swarmdsl.execution.experiments.slopes import Slopes
from swarmdsl.execution.experiments.study.analysis import Analysis, Answer, Result
from swarmdsl.execution.experiments.study.plan import Study


def as_data(found: Analysis, subject: str) -> dict[str, Any]:
    """Return everything as JSON types; times are in seconds."""
    study = found.study
    data: dict[str, Any] = {
        "experiment": str(study.path),
        "subject": subject,
        "design": study.design,
        "repetitions": study.repetitions,
        "first_seed": study.seed,
        "confidence": study.confidence,
        "measure": found.measure,
        "goal": found.goal,
        "factors": [each.name for each in study.factors],
        "points": [_result(study, each) for each in found.results],
        "best": _settings(study, found.best) if found.best is not None else None,
        "answers": [_answer(each) for each in (*found.levels, *found.points)],
    }
    if found.today is not None:
        data["today"] = _summary(found.today)
    if found.effects is not None:
        data["effects"] = _effects(found.effects)
    if found.slopes is not None:
        data["slopes"] = _slopes(found.slopes)
    names = [each.name for each in study.factors]
    if found.screened:
        data["elementary_effects"] = [
            {"factor": name, "size": each.size, "mean": each.mean, "deviation": each.deviation}
            for name, each in zip(names, found.screened, strict=True)
        ]
    if found.indices:
        data["sobol_indices"] = [
            {
                "factor": name,
                "first": each.first,
                "first_interval": list(each.first_interval),
                "total": each.total,
                "total_interval": list(each.total_interval),
            }
            for name, each in zip(names, found.indices, strict=True)
        ]
    return data


def _settings(study: Study, result: Result) -> dict[str, Value]:
    pairs = zip(study.factors, result.point, strict=True)
    return {each.name: value for each, value in pairs}


def _result(study: Study, result: Result) -> dict[str, Any]:
    return {"settings": _settings(study, result), **_summary(result)}


def _summary(result: Result) -> dict[str, Any]:
    found: dict[str, Any] = {"runs": len(result.rows), "values": len(result.values)}
    if result.sample is not None:
        found |= _sample(result.sample)
    if result.failures:
        found["failures"] = [
            {"seed": row.seed, "reason": row.failure or "it has no value"}
            for row in result.failures
        ]
    if result.violations:
        found["violations"] = result.violations
    return found


def _sample(sample: Sample) -> dict[str, Any]:
    return {
        "mean": sample.mean,
        "deviation": sample.deviation,
        "interval": _interval(sample.interval),
        "median": sample.quantiles[3],
    }


def _interval(found: Interval | None) -> list[float] | None:
    return list(found) if found is not None else None


def _answer(answer: Answer) -> dict[str, Any]:
    found = answer.comparison
    return {
        **({"factor": answer.factor} if answer.factor else {}),
        "a": answer.a,
        "b": answer.b,
        "better": found.answer,
        "difference": found.difference,
        "interval": _interval(found.interval),
        "level": found.level,
        "paired": found.is_paired,
        "runs": found.runs,
        "effect_size": found.size,
        "superiority": found.superiority,
        "more_runs": found.more,
    }


def _effects(found: Effects) -> dict[str, Any]:
    return {
        "mean": found.mean,
        "seeds": len(found.seeds),
        "left_out": found.left_out,
        "main": [_effect(each) for each in found.main],
        "interactions": [_effect(each) for each in found.interactions],
        "rest": found.rest,
    }


def _effect(effect: Effect) -> dict[str, Any]:
    return {
        "factors": list(effect.factors),
        "share": effect.share,
        "size": effect.size,
        "certain": effect.is_certain,
        "levels": [
            {
                "levels": list(each.levels),
                "mean": each.mean,
                "interval": _interval(each.interval),
                "adds": each.added,
                "adds_interval": _interval(each.added_interval),
            }
            for each in effect.levels
        ],
    }


def _slopes(found: Slopes) -> dict[str, Any]:
    return {
        "explained": found.explained,
        "seeds": len(found.seeds),
        "left_out": found.left_out,
        "slopes": [
            {
                "factor": each.factor,
                "from": each.start,
                "to": each.end,
                "change": each.change,
                "interval": _interval(each.interval),
                "certain": each.is_certain,
            }
            for each in found.slopes
        ],
    }
