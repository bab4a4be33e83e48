"""Scenario hand_limits on the built FMUs: how stiff a wall the handle may touch."""

from exo.experiment import Experiment
from exo.handfigures import limits_table

SCENARIO = "hand_limits"


def test_natural_admittance_holds_the_stiffest_hand_and_the_reaction_of_the_paper_a_seventh_more_than_none(
    experiment: Experiment,
) -> None:
    table = limits_table(experiment.recordings)
    rows = list(zip(table["law"], table["b_h [N·s/m]"], table["limit of k_h [N/m]"], table["grew"], strict=True))
    limit = {(law, b_h): value for law, b_h, value, _ in rows}
    for b_h in (0.0, 5.0, 10.0, 20.0):
        assert limit["natural", b_h] > 80.0 * limit["passive", b_h]
        assert 1.1 < limit["passive", b_h] / limit["standard", b_h] < 1.2
    # Six laws, four dampings, both sides of each limit; the three cases of no hand are not among them.
    assert sum(grew for *_, grew in rows) == 24 == len(rows) // 2


def test_the_walls_that_no_sensor_sees_are_really_pressed_on(experiment: Experiment) -> None:
    for law in ("standard", "passive", "passive_applied", "passive_bounded"):
        recording = experiment.recordings[f"unseen_{law}"]
        late = recording.time > 8.0
        assert (recording["plant.tau_e"][late] < -0.3).all()
        assert (recording["plant.q"][late] > 0.01).all()
