# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The Graupel authors
"""Small inputs that go wrong easily, each run to its right value: tests/cases/.

Called with the path of the binary. Where two runs are compared, the second one is the
same but for what must not matter.
"""

import hashlib
import json
import math
import shutil
import subprocess

from runs import ROOT, RunTest, call, main

from common.program import FAULT
from graupel.report.reference import ergun_pressure_drop

CASES = ROOT / "tests" / "cases"
# A tenth of a sphere's diameter [m]: what two packings of the same bed may differ by.
TENTH = 2e-4
# Of two solutions of the same flow: the linear solver's tolerance is 1e-8, through some
# ten systems.
SAME_FLOW = 1e-6


class CaseTest(RunTest):
    """Runs cases in a copy of their folder."""

    def setUp(self):
        super().setUp()
        shutil.copytree(CASES, self.path, dirs_exist_ok=True)

    def run_case(self, name, values=None, *more, **options):
        """The run of a case with the overridden @p values."""
        return self.run_file(f"{name}.prm", values, *more, **options)

    def finished(self, *arguments, **options):
        """The same of a run that must reach its end."""
        run = self.run_case(*arguments, **options)
        self.assertEqual(run.status, 0, run)
        return run

    def refused(self, name, values=None, *more, says=(), **options):
        """A run that must be refused, in a sentence with these words."""
        run = self.run_case(name, values, *more, **options)
        self.assertEqual(run.status, 1, run)
        for word in says:
            self.assertIn(word, run.refusal)
        self.assertNotIn("Additional information", run.refusal, "a stack trace")
        return run

    def checked(self, name, values=None, says=()):
        """What --check must refuse, naming its words; it writes nothing."""
        run = self.refused(name, values, "--check", says=says)
        self.assertFalse(run.directory.exists())


class OpenBoundaries(CaseTest):
    """Pressures that are prescribed, and what flows then."""

    def test_the_level_of_the_outlet_does_not_matter(self):
        right = self.finished("outlet-pressure", {"Boundary conditions/top": "pressure 0"}).case
        for level in (1000, 101325):
            case = self.finished(
                "outlet-pressure", {"Boundary conditions/top": f"pressure {level}"}
            ).case
            # 1e-8 of the level may be left of it, against a drop of 1 Pa: 1e-3.
            tolerance = max(SAME_FLOW, 1e-8 * level)
            for key in ("fluid_force", "pressure_drop"):
                self.assert_close(case[key], right[key], tolerance, f"{key} at {level} Pa")
            self.assertIs(case["fluidized"], False)

    def test_nor_does_that_of_an_inlet(self):
        low, high = (
            self.finished(
                "inlet-pressure",
                {
                    "Boundary conditions/bottom": f"pressure {level + 10}",
                    "Boundary conditions/top": f"pressure {level}",
                },
            ).case
            for level in (0, 1000)
        )
        for key in ("fluid_force", "pressure_drop", "superficial_velocity"):
            self.assert_close(high[key], low[key], 1e-5, key)

    def test_a_drop_of_10_pascal_is_one(self):
        run = self.finished("inlet-pressure")
        self.assert_close(run.case["pressure_drop"], 10.0, 1e-6, "pressure drop")
        # What a plug must have to drop as much.
        velocity = run.case["superficial_velocity"]
        # With 9.13 Pa it were 0.433 m/s, as before the entering momentum was counted.
        self.assert_within(velocity, 0.461, 0.005, "what flows")
        plug = self.finished(
            "inlet-velocity",
            {"Boundary conditions/bottom": "plug", "Flow/superficial velocities": velocity},
        )
        # A plug enters also where spheres touch the bottom: per cents of the first cell.
        self.assert_close(plug.case["pressure_drop"], 10.0, 0.03, "drop of the plug")
        self.assert_balanced(run)

    def test_what_enters_by_expressions_is_what_is_reported(self):
        given = self.finished("inlet-velocity")
        plug = self.finished(
            "inlet-velocity",
            {"Boundary conditions/bottom": "plug", "Flow/superficial velocities": 0.6},
        )
        self.assert_close(given.case["superficial_velocity"], 0.6, 1e-6, "velocity")
        self.assert_within(given.case["deviation_from_ergun"], -0.367, 1e-3, "deviation")
        for key in ("pressure_drop", "ergun_pressure_drop", "gradient_deviation_from_ergun"):
            self.assert_close(given.case[key], plug.case[key], 1e-5, key)


class BedsAnywhere(CaseTest):
    """Beds that do not stand on z = 0, and what is no bed."""

    def expect_the_same_bed_higher(self, height):
        # Cells of half a diameter: three times as large, they lose a third of the drop at
        # the lower end of a bed of 7 mm.
        here, there = (
            self.finished("floor", {"Walls/planes": planes, "Mesh/cell size": 1e-3})
            for planes in ("", f"0 0 {height} 0 0 -1")
        )
        for key in ("bed_height", "mean_void_fraction", "pressure_drop"):
            self.assertIsNotNone(there.case[key], key)
        self.assert_within(there.case["bed_height"], here.case["bed_height"], TENTH, "height")
        # A tenth of a diameter in 7 mm is 0.017 of the void fraction.
        void = [run.case["mean_void_fraction"] for run in (there, here)]
        self.assert_within(*void, 0.017, "void fraction")
        # The bed is not the same sphere by sphere, and one end more is smeared by the
        # filter: a tenth of a bed of three diameters.
        self.assert_close(
            there.case["pressure_drop"], here.case["pressure_drop"], 0.13, "pressure drop"
        )
        self.assertIs(there.case["fluidized"], False)
        rise = there.middle_of_solids() - here.middle_of_solids()
        self.assert_within(rise, height, TENTH, "higher by")
        return there

    def test_a_floor_above_the_bottom(self):
        case = self.expect_the_same_bed_higher(0.003).rows("monitors.csv")[-1]
        carried = case["support_force"] + case["fluid_force"]
        # As forces_balance of the command line: what the particles still move.
        self.assert_close(carried, self.weight(), 0.01, "carried")

    def test_a_floor_above_half_of_the_bed(self):
        self.expect_the_same_bed_higher(0.006)

    @staticmethod
    def weight():
        """Of 100 spheres of 2 mm [N]."""
        return 100 * math.pi / 6 * 2e-3**3 * 2700 * 9.81

    def test_a_bed_at_the_lid(self):
        case = self.finished("lid").case
        # It is one bed of 7 mm or none at all; 15 mm would reach from the floor.
        if case["bed_height"] is not None:
            self.assert_within(case["bed_height"], 7e-3, 1.5e-3, "height")
        for key in ("deviation_from_ergun", "gradient_deviation_from_ergun"):
            self.assertIsNone(case[key], key)

    def test_a_single_sphere(self):
        case = self.finished("coarse").case
        self.assertIsNone(case["gradient_deviation_from_ergun"])
        self.assert_close(case["superficial_velocity"], 0.3, 1e-6, "velocity")
        self.assertGreater(case["fluid_force"], 0.0)

    def test_nothing_to_fill_in_is_told(self):
        self.refused("none", says=["Filling/mass"])

    def test_a_gate_that_is_gone(self):
        gate = self.finished("gate", output="o-gate")
        bed = self.finished("nogate")
        fall = gate.middle_of_solids() - bed.middle_of_solids()
        self.assert_within(fall, 3e-3, TENTH, "fall")


class Resuming(CaseTest):
    """What goes on from a checkpoint."""

    def test_another_flow_under_the_old_name(self):
        self.assertEqual(self.run_case("resume", output="o").status, FAULT)
        values = {"Boundary conditions/bottom": "plug", "Flow/superficial velocities": "0.6"}
        run = self.run_case("resume", values, "--resume", output="o")
        if run.status == 0:
            self.assert_close(run.case["pressure_drop"], 6.85, 0.01, "pressure drop")
        else:
            self.assertIn("Flow/superficial velocities", run.refusal)

    def test_a_moving_bed_goes_on_bit_by_bit(self):
        def entering(until):
            return {"Boundary conditions/bottom": f"velocity 0; 0; V*(t > {until} ? 1e300 : 1)"}

        whole = self.finished("restart", entering(1000), output="whole")
        cut = self.run_case("restart", entering(0.08001), output="cut")
        self.assertEqual(cut.status, FAULT)
        resumed = self.finished("restart", entering(1000), "--resume", output="cut")
        one, other = whole.rows("monitors.csv"), resumed.rows("monitors.csv")
        self.assertEqual(len(one), len(other))
        for there, here in zip(one, other):
            self.assertEqual(there, here)


class InTime(CaseTest):
    """Time schemes, first steps and steps that are too long."""

    def test_two_steps_of_the_past_are_used(self):
        drops = []
        for scheme in ("bdf1", "bdf2"):
            run = self.finished("bdf2", {"Flow solver/time scheme": scheme})
            drops.append([row["pressure_drop"] for row in run.rows("monitors.csv")
                          if row["phase"] == "flow"])  # fmt: skip
        one, two = drops
        self.assertNotEqual(one, two)
        # The same flow in the end.
        self.assert_close(two[-1], one[-1], 0.01, "last drop")

    def test_next_to_nothing_enters_in_the_first_step(self):
        run = self.finished("step")
        self.assert_balanced(run)
        self.assertGreater(run.case["pressure_drop"], 0.0)

    def test_a_bed_rises_alike_with_any_step(self):
        # Where the drag lags behind the bed by half a step, 20 ms carry it 8 % further.
        def rise(step):
            run = self.finished("lift", {"Flow/time step": step})
            heights = [row["center_of_mass"] for row in run.rows("monitors.csv")
                       if row["phase"] == "flow"]  # fmt: skip
            return max(heights) - heights[0]

        expected = rise(1e-3)
        for step in (5e-3, 2e-2):
            self.assert_close(rise(step), expected, 0.03, f"rise with steps of {step} s")

    def test_small_spheres_in_water_rest(self):
        run = self.finished("water")
        case = run.case
        # The weight in water over the section is 13.97 Pa; the wall holds the rising bed
        # back with some per cent more. Steps of 0.05 and 0.2 ms, far below the particles'
        # response, end at 14.40 and 14.37 Pa.
        section = math.pi / 4 * 3e-3**2
        buoyancy = 998 * 9.81 * run.bed["solid_volume"]
        load = case["weight"] - buoyancy - case["support_force"]
        # The bed still rises: with steps of 0.05 to 5 ms the drop is 0.999 to 1.015 of it.
        self.assert_close(case["pressure_drop"] * section, load, 0.02, "carried")
        self.assert_close(case["pressure_drop"], 14.40, 0.02, "pressure drop")
        self.assertLess(run.rows("monitors.csv")[-1]["maximum_speed"], 5e-3)

    def test_a_step_of_its_own_keeps_to_the_response(self):
        run = self.finished("water", {"Flow/flow-throughs": 0.02, "Flow/ramp time": 0})
        self.assertIn("by the particles' response to the drag", run.said)
        self.assertNotIn("warning", run.said)

    def test_a_step_beyond_the_response_is_kept_and_told(self):
        # 0.4 mm glass in water responds within 1.2 ms; the case lasts 0.03 s, six steps.
        values = {"Flow/flow-throughs": 0.02, "Flow/ramp time": 0, "Flow/time step": 5e-3}
        checked = self.run_case("water", values, "--check").said
        self.assertIn("step of the fluid by the particles' response", checked)
        self.assertIn("warning: in a bed at rest Flow/time step = 0.005 s", checked)
        run = self.finished("water", values)
        self.assertIn("warning: at ", run.said)
        self.assertIn("Try auto", run.said)
        rows = [row for row in run.rows("monitors.csv") if row["phase"] == "flow"]
        self.assertEqual(len(rows), 6)

    def test_steps_of_ten_times_the_response_are_stable_and_right(self):
        # Glass of 0.1 mm in air. At rest the drop is that of any step; a bed that comes loose
        # is carried from the first step on, but for what friction at the wall does: 1.5
        # times its weight if the fluid did not know that it lifts off.
        # The filter is that of the loose bed for both.
        short = self.finished("fine", {
            "Flow/superficial velocities": 0.006, "Coupling/filter length": 2e-4 / 2**0.5,
        })  # fmt: skip
        run = self.finished("fine", {"Flow/time step": 3e-2})
        resting, loose = run.rows("cases.csv")
        self.assert_close(resting["pressure_drop"], short.case["pressure_drop"], 1e-3, "at rest")
        self.assertFalse(resting["fluidized"])
        rows = [row for row in run.rows("monitors.csv") if row["phase"] == "flow"]
        moving = [row for row in rows if row["case"] == rows[-1]["case"]]
        self.assertGreater(len(moving), 3)
        for row in moving:
            self.assert_close(row["fluid_force"], loose["weight"], 0.06, "carried by the air")

    def test_filters_and_scales_that_resolve_nothing_are_told(self):
        values = {"Flow/superficial velocities": 0.3, "Coupling/filter length": 5e-4}
        self.assertIn("its own disturbance", self.run_case("bed20", values, "--check").said)
        values = {"Flow/superficial velocities": 0.3, "Particles/scale": 2, "Filling/count": 20}
        self.assertIn("across the vessel", self.run_case("bed20", values, "--check").said)

    def test_cells_that_smear_a_bed_are_told(self):
        # Spheres of 1.2 mm: cells of 3.5 diameters are told, those of 2.5 are not.
        values = {"Flow/superficial velocities": 0.3, "Particles/diameter": 1.2e-3}
        coarse = {**values, "Mesh/cell size": 4.2e-3}
        self.assertIn("smear the ends", self.run_case("bed20", coarse, "--check").said)
        self.assertNotIn("smear the ends", self.run_case("bed20", values, "--check").said)

    def test_corks_float_to_the_lid(self):
        run = self.finished("cork")
        # 100 spheres at a void fraction of 0.46 are 7 mm of bed, here below the lid.
        middle = run.middle_of_solids("profiles-01.csv")
        self.assert_within(middle, 0.02 - 3.4e-3, 1e-3, "middle of the corks")


class Ranks(CaseTest):
    """What a division among ranks must not show."""

    def test_the_solver_hardly_notices(self):
        # The first steps of a flow that jumps to its velocity, on 0.5.0 none on two ranks.
        values = {
            "Flow/mode": "transient",
            "Flow/time step": 2e-3,
            "Flow/duration": 0.006,
            "Flow/ramp time": 0,
            "Output/report": "false",
        }
        alone, *others = (
            self.run_file(ROOT / "tests" / "cases" / "shallow.prm", values, ranks=ranks)
            for ranks in (1, 2, 3)
        )
        for run in (alone, *others):
            self.assertEqual(run.status, 0, run)
            self.assert_close(run.case["pressure_drop"], alone.case["pressure_drop"], 1e-8, "drop")
            here, there = (
                [row["linear_iterations"] for row in one.rows("monitors.csv") if row["phase"] == "flow"]
                for one in (run, alone)
            )
            self.assertEqual(len(here), len(there))
            self.assertGreater(here[0], 1)
            self.assertLessEqual(here[0], 1.5 * there[0], "iterations of the first step")
            self.assertLessEqual(sum(here), 1.5 * sum(there), "iterations")


class Sizes(CaseTest):
    """Spheres by their own sizes, whatever the type's diameter."""

    def test_the_same_spheres_give_the_same_numbers(self):
        texts, cases = [], []
        for diameter in ("2e-3", "3e-3"):
            values = {"Particles/diameter": diameter}
            texts.append(self.run_case("size-list", values, "--check").said)
            case = self.finished("size-list", values).case
            cases.append({k: v for k, v in case.items() if "seconds" not in k})
        self.assertEqual(*texts)
        self.assertEqual(*cases)

    def test_sizes_that_no_type_declares(self):
        # At rest without gravity and flow: the overlap of 0.2 mm drives them apart.
        found = []
        for ranks in (1, 3):
            run = self.run_case("list9", ranks=ranks)
            if run.status == 0:
                found.append(sorted(map(tuple, run.particles(0).points)))
            else:
                self.assertIn("two.csv, line 2", run.refusal)
                self.assertIn("type", run.refusal)
                found.append(None)
        self.assertEqual(*found)

    def test_a_sphere_of_a_tenth(self):
        run = self.run_case("small", timeout=60)
        if run.status == 0:
            center = run.particles(0).points[0]
            # At rest on the bottom, which it touches at its radius.
            self.assert_within(center[2], 1e-4, 1e-6, "height of its center")
        else:
            self.assertIn("small.csv, line 2", run.refusal)
            self.assertIn("type", run.refusal)


class Filling(CaseTest):
    """How much is filled in, where, and when."""

    def test_a_rate_that_is_no_whole_number_a_layer(self):
        for rate in (630, 650):
            rows = self.finished("rate", {"Filling/rate": rate}).rows("monitors.csv")
            filling = [row for row in rows if row["phase"] == "fill"]
            # A row each 10 ms, to 100 spheres after 0.159 and 0.154 s.
            self.assertGreaterEqual(len(filling), 15)
            for row in filling:
                due = min(100, rate * row["time"])
                self.assert_within(row["particles"], due, 1.0, f"after {row['time']} s")
            self.assert_within(filling[-1]["time"], 100 / rate, 0.012, "filled after")

    def test_what_leaves_while_it_is_filled_in(self):
        try:
            run = self.run_case("leak", timeout=60)
        except subprocess.TimeoutExpired:
            self.fail("it does not end")
        self.assertTrue(run.status == 0 or "Walls/bottom" in run.refusal, run)

    def test_none_inside_a_closed_box(self):
        centers = self.finished("box").particles(0).points
        self.assertEqual(len(centers), 60)
        # box.stl: a prism with a slanting side, in metres.
        inside = [
            (x, y, z)
            for x, y, z in centers
            if abs(x) < 3e-3 and -3e-3 < y < 3e-3 + 1.5e-3 * (x / 3e-3 + 1) and 6e-3 < z < 12e-3
        ]
        self.assertEqual(inside, [])

    def test_half_a_tube_needs_half_as_much(self):
        whole, half = self.finished("half", {"Walls/planes": ""}), self.finished("half")
        self.assert_within(half.bed["height"], 6e-3, 1e-3, "height")
        ratio = half.bed["particle_count"] / whole.bed["particle_count"]
        self.assert_within(ratio, 0.5, 0.02, "spheres over those of the whole tube")
        # Two walls more: looser by some per cent.
        void = half.bed["mean_void_fraction"]
        self.assert_within(void, whole.bed["mean_void_fraction"], 0.08, "void fraction")


def solid_at_wall_and_within(rows, radius):
    """Thickness and solid fraction of the layer at the wall that is looser than what it
    encloses, and the solid fraction of that, from bed-radial.csv."""
    ring = [2.0 * row["wall_distance"] for row in rows]
    edges = [0.0]
    for twice in ring:
        edges.append(twice - edges[-1])
    area = [(radius - a) ** 2 - (radius - b) ** 2 for a, b in zip(edges, edges[1:])]
    solid = [1.0 - row["void_fraction"] for row in rows]
    layer = within = 0
    for layer in range(len(rows)):
        within = sum(s * a for s, a in zip(solid[layer:], area[layer:])) / sum(area[layer:])
        if solid[layer] >= within:
            break
    at_wall = sum(s * a for s, a in zip(solid[:layer], area[:layer])) / sum(area[:layer])
    return edges[layer], at_wall, within


class OriginalBed(CaseTest):
    """The void fraction of the particles that scaled ones stand for."""

    def test_follows_the_layer_at_the_wall(self):
        run = self.finished("orig", {"Original bed/void fraction": "correlation"})
        radius, scale = run.bed["vessel_diameter"] / 2.0, run.bed["scale"]
        thickness, at_wall, within = solid_at_wall_and_within(run.rows("bed-radial.csv"), radius)

        def mean(thickness):
            share = 1.0 - (1.0 - thickness / radius) ** 2
            return within + (at_wall - within) * share

        ratio = mean(thickness / scale) / mean(thickness)
        self.assertGreater(ratio, 1.02)
        # The program's shells are half as wide; where the layer ends counts in second order.
        self.assert_close(run.bed["original_solid_ratio"], ratio, 2e-3, "ratio")
        original = 1.0 - run.bed["original_void_fraction"]
        simulated = 1.0 - run.bed["mean_void_fraction"]
        ends = (1.0 - simulated / mean(thickness)) / scale
        self.assert_close(original, mean(thickness / scale) * (1.0 - ends), 2e-3, "original")

    def test_is_the_same_on_two_ranks(self):
        packed = {"Original bed/void fraction": "simulated", "Flow/superficial velocities": ""}
        one, two = (self.finished("orig", packed, ranks=ranks).bed for ranks in (1, 2))
        self.assertEqual(one["original_void_fraction"], two["original_void_fraction"])

    def test_the_ladder_multiplies_what_is_smooth(self):
        run = self.finished("orig", {
            "Original bed/void fraction": "simulated",
            "Refinement study/vary": "scale",
            "Refinement study/values": "3, 2.5, 2",
        })  # fmt: skip
        rows = [row for row in run.rows("study.csv") if row["level"] == 3]

        def at_one(start):
            (row,) = [row for row in rows if row["quantity"].startswith(start)]
            return row["extrapolated"], row["grid_convergence_index"]

        drop, error = at_one("pressure drop at")
        over, of_over = at_one("pressure drop over Ergun's")
        ergun, of_ergun = at_one("Ergun's value of the original bed")
        self.assert_close(drop, over * ergun, 1e-8, "drop")
        self.assert_close(error, math.hypot(of_over, of_ergun), 1e-8, "error")
        # Ergun's value at the void fraction that the bed tells, for its solid on the section.
        bed = json.loads((run.directory / "level-3" / "summary.json").read_text())["bed"]
        solid = 1.0 - bed["original_void_fraction"]
        height = bed["height"] * (1.0 - bed["mean_void_fraction"]) / solid
        level = [row["value"] for row in rows if row["quantity"].startswith("Ergun's value")]
        fluid = (1.18415, 1.85508e-5)
        expected = ergun_pressure_drop(0.3, height, 1.0 - solid, 1e-3, *fluid)
        self.assert_close(level[0], expected, 1e-6, "Ergun's value of the original bed")

    def test_of_unscaled_particles_is_their_own(self):
        run = self.finished("orig", {"Original bed/void fraction": "correlation",
                                     "Particles/scale": 1, "Particles/diameter": 2e-3})  # fmt: skip
        self.assertEqual(run.bed["original_solid_ratio"], 1.0)
        self.assert_within(
            run.bed["original_void_fraction"], run.bed["mean_void_fraction"], 1e-12
        )


class CheckedBeforehand(CaseTest):
    """What --check and a run must refuse before anything is written."""

    def test_an_original_bed_higher_than_the_vessel(self):
        for check in (("--check",), ()):
            run = self.refused("orig", None, *check, says=["Original bed", "0.05", "0.02"])
            self.assertFalse(run.directory.exists())

    def test_a_correlation_outside_of_a_cylinder(self):
        correlation = {"Original bed/void fraction": "correlation"}
        run = self.run_file(CASES / "orig.prm", correlation, "--check")
        self.assertEqual(run.status, 0, run)
        for reason, values in (
            ("other walls", {"Walls/planes": "0.004 0 0 1 0 0"}),
            ("three simulated particles", {"Particles/scale": 5, "Filling/count": 4}),
        ):
            self.checked(
                "orig", {**correlation, **values}, says=["Original bed/void fraction", reason]
            )

    def test_numbers_that_no_run_has(self):
        for name, value, words in (
            ("Contact/substep", 5e-324, "inf substeps of the particles"),
            ("Flow/time step", 1e-13, "steps of the fluid"),
            ("Output/interval", 1e-9, "sets of ParaView files"),
            ("Mesh/cell size", 2e-5, "larger cells"),
            ("Flow/superficial velocities", 1e308, "Reynolds number"),
        ):
            self.checked("bed20", {"Flow/superficial velocities": 0.3, name: value}, (name, words))

    def test_files_that_are_not_there(self):
        self.checked("bed20", {"Walls/surfaces": "missing.stl"}, says=["missing.stl"])
        self.checked("list9", {"Filling/file": "missing.csv"}, says=["missing.csv"])
        self.checked("bed20", {"Filling/start from": "nowhere"}, says=["Filling/start from"])
        self.checked("bed20", {"Mesh/file": "missing.msh"}, says=["Mesh/file"])

    def test_a_sphere_wider_than_the_tube(self):
        values = {"Particles/size list": "3e-3: 1, 13e-3: 1", "Geometry/height": 0.1}
        self.checked("size-list", values, says=["Particles/size list"])

    def test_a_pair_with_a_wall_that_is_not_there(self):
        for wall in ("plane 7", "door"):
            self.checked(
                "bed20", {"Contact/pairs": f"1-{wall} friction 0.3"}, says=["Contact/pairs", wall]
            )

    def test_every_level_of_a_study(self):
        # The second level's filter is wider than the vessel.
        values = {
            "Filling/start from": "",
            "Refinement study/vary": "scale",
            "Refinement study/values": "8, 1",
        }
        self.checked("study", values, says=["Refinement study/values", "8"])

    def test_a_study_of_which_no_level_can_begin(self):
        self.checked("study", says=["Filling/start from"])
        for ranks in (1, 2):
            run = self.refused("study", says=["nowhere"], ranks=ranks)
            self.assertFalse((run.directory / "study.csv").exists())

    def test_a_filter_too_short_is_to_blame(self):
        self.refused("filter0", says=["Coupling/filter length"])


class OutputDirectory(CaseTest):
    """What an earlier run has left."""

    def contents(self):
        return {
            str(file.relative_to(self.path)): hashlib.sha256(file.read_bytes()).hexdigest()
            for file in (self.path / "o").rglob("*")
            if file.is_file()
        }

    def test_a_refusal_removes_nothing(self):
        self.finished("outlet-pressure", output="o")
        before = self.contents()
        for values in (
            {"Walls/surfaces": "missing.stl"},
            {"Filling/method": "list", "Filling/file": "missing.csv"},
            {"Filling/start from": "nowhere"},
        ):
            self.refused("outlet-pressure", values, output="o")
            self.assertEqual(before, self.contents(), values)

    def test_its_own_bed_serves_again(self):
        first = self.finished("bed20", output="o").bed
        again = self.finished("bed20", {"Filling/start from": "o"}, output="o").bed
        for key in ("height", "mean_void_fraction"):
            self.assert_close(again[key], first[key], 1e-3, key)

    def test_a_study_of_another_time_is_gone(self):
        self.finished("bed20", output="o")
        (self.path / "o" / "study.csv").write_text("level\n", encoding="utf-8")
        (self.path / "o" / "notes.txt").write_text("mine\n", encoding="utf-8")
        self.finished("bed20", output="o")
        self.assertFalse((self.path / "o" / "study.csv").exists())
        self.assertTrue((self.path / "o" / "notes.txt").exists())


class ParameterText(CaseTest):
    """Text that is not what it looks like."""

    def test_a_comment_swallows_nothing(self):
        (self.path / "comment.prm").write_text(
            "include bed20.prm\nsubsection Particles\n  # of C:\\beds\\\n"
            "  set density = 1234\nend\n",
            encoding="utf-8",
        )
        told = call("comment.prm", "--print-parameters", cwd=self.path).stdout
        self.assertRegex(told, r"set density +=  *1234")

    def test_a_name_with_a_hash_is_read_back(self):
        run = self.finished("bed20", output="run#1")
        again = call("run#1/parameters.prm", "--print-parameters", cwd=self.path)
        self.assertEqual(again.returncode, 0, again.stderr)
        line = next(text for text in again.stdout.splitlines() if "set directory" in text)
        self.assertEqual(line.split("=", 1)[1].split(" #")[0].strip(), "run#1")
        self.assertTrue(run.directory.is_dir())

    def test_words_end_at_a_blank_and_numbers_are_numbers(self):
        for name, value in (
            ("Boundary conditions/top", "pressure100"),
            ("Particles/size list", "1e-3: abc"),
            ("Walls/planes", "0 0 nan 0 0 -1"),
            ("Contact/pairs", "1-1 friction inf"),
            ("Particles/gravity", "0, abc, 1"),
            ("Output/probes", "middle: 0 0 nan"),
            ("Coupling/filter length", "nan"),
            ("Flow/superficial velocities", "0.3, inf"),
        ):
            self.checked("size-list", {name: value}, says=[name])


if __name__ == "__main__":
    main()
