// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_simulation_studies_study_h
#define graupel_simulation_studies_study_h

#include <graupel/base/progress.h>
#include <graupel/simulation/parameters/run_parameters.h>

#include <functional>
#include <optional>

namespace graupel
{
  /** How the value at scale 1 follows from those of larger scales: by the polynomial
   * through them (base/convergence.h, extrapolate); as the mean of what each tells of
   * scale 1 by itself (mean_at); or as a product of other quantities. */
  enum class AtScaleOne
  {
    polynomial,
    mean,
    product
  };

  /** A number that a level of a study came to. */
  struct Measurement
  {
    std::string quantity;
    /** Nothing where the level has no such number. */
    std::optional<double> value;
    /** Whether it is an error, that is whether the exact value is known to be 0. */
    bool is_error = false;
    /** Of the mean over several beds; 0 for a single one. */
    double standard_error = 0.;
    /** How a ladder comes to the value at scale 1. */
    AtScaleOne at_scale_one = AtScaleOne::polynomial;
    /** Quantities whose values there multiply to this one's, if it is a product. */
    std::vector<std::string> factors = {};
  };

  /** What one level of a study computed. */
  struct LevelResult
  {
    unsigned int cells = 0;
    /** Representative: (volume / cells)^(1/3) [m]. */
    double cell_size     = 0.;
    double time_step     = 0.; // [s]
    double filter_length = 0.; // [m]
    double scale         = 1.; // [-]
    /** Without any of these if it has failed. */
    std::vector<Measurement> measurements;
    bool                     has_failed = false;
  };

  /** Runs one level with these parameters, its files in its own directory. */
  using RunLevel = std::function<LevelResult(const RunParameters &parameters,
                                             const std::string   &directory)>;

  /** One row of study.csv. */
  struct StudyRow
  {
    unsigned int level; // from 1
    LevelResult  result;
    Measurement  measurement;
    std::optional<double>
      error_or_change; // error; or relative change from the last level
    std::optional<double> observed_order, extrapolated, index;
    bool                  oscillates = false;
  };

  /**
   * The rows of a study whose levels have the sizes @p sizes (of what varies), from the
   * coarsest to the finest: errors with the order between two levels, other quantities
   * with order, Richardson's value and grid-convergence index of three
   * (base/convergence.h). The quantities are those of the first level that has any. A
   * level that has failed, or has no such number, is a hole: it has rows without a value,
   * and nothing is computed across it.
   */
  std::vector<StudyRow> evaluate_study(const std::vector<LevelResult> &levels,
                                       const std::vector<double>      &sizes);

  /**
   * The rows of a ladder of scales, from the largest to the smallest: from the third
   * level on with the value at scale 1, as each quantity comes to it, whose relative
   * error stands as index. It begins anew behind a hole, as in a study.
   */
  std::vector<StudyRow> evaluate_ladder(const std::vector<LevelResult> &levels);

  /**
   * The mean of repeated levels, which measured the same quantities, with standard
   * errors: s / sqrt(n), the deviation s being estimated with n - 1. No number where one
   * of them has none.
   */
  LevelResult mean_of(const std::vector<LevelResult> &repetitions);

  /**
   * A refinement study: runs the same parameters on a list of mesh sizes, filter
   * lengths, time steps or scales, in the subdirectories level-1, level-2, ... (level-1-2
   * for its second bed) of @p directory, and writes study.csv there and a table to @p
   * progress. check_levels() must have passed. A level that fails on all ranks is told,
   * with its reason, and the others go on; a failure of one rank alone is thrown, as the
   * others wait for it. Without anything to vary it is level 1 alone. Returns whether
   * every level has succeeded. Collective.
   */
  bool run_study(const RunParameters &parameters,
                 const RunLevel      &run_level,
                 const std::string   &directory,
                 Progress            &progress,
                 MPI_Comm             communicator);
} // namespace graupel

#endif
