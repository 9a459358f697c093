"""Laws of each space: energy is balanced, bodies have limits, walls are solid.

A turned or moved world does the same, and so does each run alone.
"""

import numpy as np
import pytest
from tests.space.stages import (
    FLYER,
    WALKER,
    Play,
    battery,
    box,
    disc,
    stage,
    things,
    units,
    wall,
)

from swarmdsl.execution.space.layout import Eye, Radio
from swarmdsl.execution.space.radio import Links

STATE = ("x", "y", "z", "vx", "vy", "heading_x", "energy", "used", "distance")


def _wander(on, steps, each=lambda: None, seed=0, hurry=3.0):
    """Let all robots want something else in each step, also more than they can."""
    chance = np.random.default_rng(seed)
    for _ in range(steps):
        wanted = chance.normal(size=(3, on.rows)) * hurry
        on.wanted_x[:], on.wanted_y[:], on.wanted_z[:] = wanted
        if chance.random() < 0.3:
            on.halt(np.arange(on.rows))
        on.ticks += 1
        for row in on.move(on.rows_of(range(len(on.seeds)))).tolist():
            on.alive[row] = False
        each()


# ---- energy


def test_used_energy_is_the_integral_of_power_and_what_batteries_lack():
    powers = {"moving": 180.0, "hovering": 150.0, "sensing": 5.0, "idling": 4.0}
    eyes = (Eye("person", 10.0),)
    of = units(4, FLYER, battery=battery(8e3, **powers), eyes=eyes)
    of += units(3, WALKER, "rover", battery=battery(500.0, moving=30.0, idling=1.0))
    on = stage(of, seeds=(1, 2), targets=(things("person", (5.0, 5.0)),))
    full, spent = on.energy.copy(), np.zeros(on.rows)

    def note():
        spent[:] += on.power * on.dt

    _wander(on, 900, note)
    assert on.used == pytest.approx(spent, rel=1e-9)
    assert full - on.energy == pytest.approx(on.used, rel=1e-9)
    assert (on.energy >= 0).all()
    assert (on.used <= full).all()
    assert (~on.alive).sum() == (on.energy == 0).sum() > 0


@pytest.mark.parametrize(
    ("wanted", "watts"), [((0, 0, 0), 150.0), ((3, 0, 0), 180.0), ((0, 0, -1), 180.0)]
)
def test_power_is_what_a_robot_does(wanted, watts):
    of = units(1, FLYER, battery=battery(1e6, moving=180.0, hovering=150.0, idling=4.0))
    play = Play(stage(of)).start("take_off", [0], height=5.0).run(10)
    on = play.stage
    on.wanted_x[:], on.wanted_y[:], on.wanted_z[:] = np.array(wanted)[:, None]
    on.move(on.rows_of([0]))
    assert on.power[0] == pytest.approx(watts)


def test_a_climb_takes_the_potential_energy_of_the_mass_too():
    """A climb of 10 m takes m g h more than moving as long on the level; going down takes less."""
    heavy = FLYER.__class__(radius=0.3, mass=4.0, speed=5.0, climb=2.0)
    cell = battery(1e6, moving=200.0)
    play = Play(stage(units(1, FLYER, battery=cell) + units(1, heavy, "lifter", battery=cell)))
    play.start("take_off", [0, 1], height=10.0).run(20)
    on = play.stage
    rise = on.z.copy()
    lifted = on.used - 200.0 * rise / 2.0
    assert lifted == pytest.approx(np.array([1.5, 4.0]) * 9.81 * rise, rel=1e-6)
    before = on.used.copy()
    play.start("land", [0, 1]).run(20)
    assert (on.used - before <= 200.0 * 6.0).all()


# ---- limits


def test_nobody_is_faster_than_its_body():
    on = stage(units(20, FLYER) + units(20, WALKER, "rover"), size=(2000.0, 2000.0, 50.0))
    was = {}

    def note():
        if was:
            way = np.hypot(on.x - was["x"], on.y - was["y"])
            assert (way <= on.speed * on.dt + 1e-9).all()
            assert (np.abs(on.z - was["z"]) <= on.climb * on.dt + 1e-9).all()
        was.update(x=on.x.copy(), y=on.y.copy(), z=on.z.copy())
        assert (on.z >= 0).all()
        assert (on.z <= 50.0).all()

    _wander(on, 400, note, hurry=20.0)
    assert on.z[:20].max() > 1
    assert on.z[20:].max() == 0


def test_the_way_is_the_sum_of_the_steps():
    on = stage(units(5, FLYER))
    was, way = np.stack([on.x, on.y, on.z]), np.zeros(5)

    def note():
        nonlocal was
        now = np.stack([on.x, on.y, on.z])
        way[:] += np.linalg.norm(now - was, axis=0)
        was = now

    _wander(on, 200, note)
    assert on.distance == pytest.approx(way)


# ---- walls


def _shapes():
    edges = wall((0, 50), (100, 50)) + box((20, 10), (30, 20), 1) + wall((60, 0), (60, 40), shape=2)
    return {"edges": edges, "rounds": (disc(75, 20, 5),), "boxes": ((20, 10, 30, 20),)}


@pytest.mark.parametrize("speed", [1.0, 30.0])
def test_no_robot_gets_into_a_wall_or_through_it(speed):
    body = WALKER.__class__(radius=0.3, speed=speed)
    on = stage(units(60, body), seeds=(1, 2), **_shapes())
    north = on.y > 50
    stopped = np.zeros(on.rows, dtype=bool)

    def note():
        stopped[:] |= on.touched
        gap = on.shapes.distances(on.x, on.y, on.z)
        assert gap.min() >= 0.3 - 1e-9
        assert ((on.y > 50) == north).all()
        assert not ((on.x > 20) & (on.x < 30) & (on.y > 10) & (on.y < 20)).any()
        assert (np.hypot(on.x - 75, on.y - 20) >= 5.3 - 1e-9).all()
        assert (np.minimum(on.x, 100 - on.x) >= 0.3 - 1e-9).all()

    _wander(on, 300, note, hurry=speed)
    assert stopped.any()


def test_who_flies_above_a_wall_passes_it():
    play = Play(stage(units(1, FLYER, starts=[(10, 10)]), edges=wall((20, 0), (20, 100), high=3.0)))
    play.start("take_off", [0], height=4.0).run(10).start("go_to", [0], to=(30.0, 10.0, 0.0)).run(
        30
    )
    assert play.outcomes() == ["succeeded"]
    play.start("land", [0]).run(10).start("go_to", [0], to=(10.0, 10.0, 0.0)).run(30)
    assert play.outcomes() == ["aborted"]
    assert play.stage.x[0] > 20


# ---- radio


def test_radio_is_symmetric_where_radios_are_alike():
    of = units(30, WALKER, radio=Radio(25.0, 0.2, 0.5))
    on = stage(of, seeds=(1, 2))
    links = Links(on)
    linked = {divmod(number, on.rows) for number in links.within().tolist()}
    assert linked
    assert linked == {(other, one) for one, other in linked}
    for run in (0, 1):
        for one in range(30):
            for other in range(30):
                reaches = links.reaches(run, one, other)
                assert reaches == links.reaches(run, other, one)
                assert links.loss(run, one, other) == pytest.approx(links.loss(run, other, one))
                if one != other:
                    assert reaches == ((run * 30 + one, run * 30 + other) in linked)


def test_radio_gets_worse_with_the_distance_and_with_walls():
    of = units(
        4, WALKER, radio=Radio(30.0, 0.4, 0.5), starts=[(10, 10), (15, 10), (35, 10), (45, 10)]
    )
    links = Links(stage(of))
    losses = [links.loss(0, 0, other) for other in (1, 2)]
    assert 0 < losses[0] < losses[1] <= 0.4
    assert [links.reaches(0, 0, other) for other in (1, 2, 3)] == [True, True, False]
    walled = Links(stage(of, edges=wall((12, 0), (12, 100))))
    assert 1 - walled.loss(0, 0, 1) == pytest.approx(0.5 * (1 - losses[0]))


# ---- symmetry


def _turned(angle, x, y, by=(0.0, 0.0)):
    cosine, sine = np.cos(angle), np.sin(angle)
    return cosine * x - sine * y + by[0], sine * x + cosine * y + by[1]


@pytest.mark.parametrize("angle", [0.0, 0.4, np.pi / 2])
def test_a_turned_and_moved_world_does_the_same(angle):
    """Robots, obstacles and wishes are turned by an angle, and moved: places are too."""
    by = (37.0, -12.0)
    chance = np.random.default_rng(5)
    starts = chance.random((12, 2)) * 40
    centres = chance.random((3, 2)) * 40
    ends = chance.random((4, 2)) * 40
    wishes = chance.normal(size=(200, 2, 12)) * 2

    def play(angle, by):
        discs = [disc(*_turned(angle, *centre, by), 2.0) for centre in centres]
        walls = wall(*(_turned(angle, *end, by) for end in ends))
        placed = [_turned(angle, *start, by) for start in starts]
        on = stage(units(12, WALKER, starts=placed), size=None, edges=walls, rounds=discs)
        ways = []
        for wish in wishes:
            on.wanted_x[:], on.wanted_y[:] = _turned(angle, *wish)
            on.ticks += 1
            on.move(on.rows_of([0]))
            ways.append((on.x.copy(), on.y.copy(), on.touched.copy()))
        return ways

    here, there = play(0.0, (0.0, 0.0)), play(angle, by)
    assert any(touched.any() for *_, touched in here)
    for (x, y, touched), (far_x, far_y, same) in zip(here, there, strict=True):
        assert (touched == same).all()
        assert np.stack(_turned(angle, x, y, by)) == pytest.approx(np.stack([far_x, far_y]))


def test_each_run_alone_is_the_same_to_the_bit():
    of = units(6, FLYER, battery=battery(1e5, moving=100.0), eyes=(Eye("person", 10.0, rate=5.0),))
    of += units(6, WALKER, "rover")
    world = {**_shapes(), "targets": (things("person", (40.0, 40.0), (80.0, 80.0)),)}

    def play(seeds):
        on = Play(stage(of, seeds=seeds, **world))
        rows = np.arange(on.stage.rows)
        roles = rows % 12
        on.start("take_off", rows[roles < 3], height=6.0)
        on.start("flock", rows[roles >= 9], noise=0.5, range=40.0)
        on.start("aggregate", rows[(roles >= 6) & (roles < 9)], range=30.0)
        on.start("random_walk", rows[(roles >= 3) & (roles < 6)])
        for _ in range(300):
            on.step()
        return on.stage

    seeds = (3, 1, 4, 15)
    together = play(seeds)
    for number, seed in enumerate(seeds):
        alone = play((seed,))
        for name in STATE:
            part = getattr(together, name)[number * 12 : number * 12 + 12]
            assert part.tobytes() == getattr(alone, name).tobytes(), name
