# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The Graupel authors
"""Long runs: what is conserved stays so, memory and open files stay as they are, and a run that is
killed again and again ends as the one that is not. Called with the path of the binary.
"""

import os
import random
import subprocess
import threading

from interrupted_runs import InterruptedRuns
from runs import Run, main

from common.program import processes_in

# What the memory of a run may be at its end, of that when it had got going [-].
GROWTH = 1.05
KILLS = 10


class Watch:
    """Memory [MB], open files and CPU time [s] of a run's only process, while it goes on."""

    def __init__(self, folder):
        self.folder = folder
        self.samples = []

    def look(self):
        """Takes a sample, if the process is there."""
        for process in processes_in(self.folder):
            try:
                pages = int((process / "statm").read_text().split()[1])
                times = (process / "stat").read_text().rsplit(")", 1)[1].split()
                files = len(os.listdir(process / "fd"))
            except OSError:  # it has ended meanwhile
                return
            self.samples.append((
                pages * os.sysconf("SC_PAGE_SIZE") / 1e6,
                files,
                int(times[11]) / os.sysconf("SC_CLK_TCK"),
            ))  # fmt: skip

    def most(self, part):
        """The most memory and open files in one fifth of the run."""
        length = len(self.samples) // 5
        return [max(column) for column in zip(*self.samples[part * length : (part + 1) * length])]


class LongRuns(InterruptedRuns):
    """Each takes minutes."""

    def watched(self, file, values):
        """A run that ends well, with the same memory and open files in its last fifth as in its
        second."""
        run, watch, said = self.start(file, values, ranks=1), Watch(self.path), []
        reader = threading.Thread(target=lambda: said.extend(run.communicate()))
        reader.start()
        while reader.is_alive():
            watch.look()
            reader.join(0.1)
        ended = subprocess.CompletedProcess(run.args, run.returncode, said[0], "")
        self.assertEqual(ended.returncode, 0, said)
        self.assertGreater(len(watch.samples), 50)
        (early, files, _), (late, files_late, seconds) = watch.most(1), watch.most(4)
        print(f"\n{file}: {early:.1f}, then {late:.1f} MB; {files}, then {files_late} open files;"
              f" {seconds:.0f} s of CPU", flush=True)  # fmt: skip
        self.assertLess(late, GROWTH * early)
        self.assertEqual(files, files_late)
        os.rename(self.path / "killed", self.path / "whole")
        return Run(ended, self.path / "whole")

    def test_a_bed_at_rest_for_a_million_substeps(self):
        run = self.watched("rest.prm", {})
        flow = [row for row in run.rows("monitors.csv") if row["phase"] == "flow"]
        self.assertGreater(run.summary["cost"]["particle_steps"], 1e6 * flow[-1]["particles"])
        first, last = flow[len(flow) // 5], flow[-1]
        for row in (first, last):
            self.assertLess(row["maximum_speed"], 1e-5)
            self.assert_close(row["support_force"], row["weight"], 1e-6, "carried")
        self.assert_close(last["center_of_mass"], first["center_of_mass"], 1e-6, "it creeps")

    def test_a_bed_with_all_that_changes(self):
        whole = self.watched("soak.prm", {})
        self.assert_balanced(whole)
        ledger = whole.summary["ledger"]
        self.assertLess(ledger["max_momentum_imbalance"], 1e-11)
        self.assertLess(ledger["max_solid_volume_error"], 1e-11)
        flow = [row for row in whole.rows("monitors.csv") if row["phase"] == "flow"]
        for row in flow:
            self.assertEqual(
                row["particles"], 1000 + row["fed_particles"] - row["departed_particles"]
            )
        self.assertGreater(flow[-1]["departed_particles"], 0)
        self.assertGreater(len({row["cells"] for row in flow}), 10)
        self.expect_the_same_after_kills("soak.prm", whole, len(flow))

    def expect_the_same_after_kills(self, file, whole, n_rows):
        """A run that is killed at random places ends as the whole one."""
        chance = random.Random(17)
        values = {"Output/checkpoint interval": 1.0}
        for kill in range(KILLS):
            run = self.start(file, values, 1, *(["--resume"] if kill else []))
            at = chance.randrange(kill * n_rows // KILLS + 1, (kill + 1) * n_rows // KILLS)
            self.wait_for_rows("flow", at, run, needs_checkpoint=True, patience=3600)
            self.kill(run)
        resumed = self.run_file(file, values, "--resume", output="killed", timeout=3600)
        self.assertEqual(resumed.status, 0, resumed)
        self.assert_same(whole.directory, (), f"killed {KILLS} times")


if __name__ == "__main__":
    main()
