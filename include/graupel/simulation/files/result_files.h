// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_simulation_files_result_files_h
#define graupel_simulation_files_result_files_h

#include <graupel/dem/bed/bed_profiles.h>
#include <graupel/fluid/flow_solver.h>
#include <graupel/simulation/files/growing_table.h>
#include <graupel/simulation/observers/case_averages.h>
#include <graupel/simulation/observers/case_result.h>
#include <graupel/simulation/observers/profiles.h>

#include <fstream>

namespace dealii
{
  template <int dim, int spacedim>
  class DataOut;
}

namespace graupel
{
  /**
   * The output directory of a run: every file in it is written here. What each
   * file holds is told in doc/output-files.md. Rank 0 writes, but for the
   * ParaView files, which all ranks write together. What cannot be written throws
   * FileError, and earlier files stay.
   */
  class ResultFiles
  {
  public:
    /** Touches nothing yet. @p field_format as in OutputParameters. */
    ResultFiles(const std::string &directory,
                MPI_Comm           communicator,
                const std::string &field_format = "vtu");

    /**
     * Makes the directory, or takes what earlier runs have written out of it, their own
     * files only, and writes parameters.prm if there is something to write. Throws
     * InputError("Output/directory", ...) if it cannot be written. Collective.
     */
    void begin(const dealii::ParameterHandler *prm = nullptr);

    /** The same where an earlier run goes on: only parameters.prm is written anew. */
    void go_on(const dealii::ParameterHandler &prm);

    /** Times [s], and what a series says of each: the name of a file, or the grid in
     * HDF5 files as XDMF has it. */
    using Records = std::vector<std::pair<double, std::string>>;

    /** The times and files of the ParaView series so far. */
    struct Written
    {
      Records fields, particles, contacts, averages;
    };

    const Written &
    written() const
    {
      return records;
    }

    /** Goes on behind what an earlier run had written up to @p time [s]; what came
     * later is dropped. */
    void continue_from(const Written &earlier, const double time);

    /** log.txt; writes nothing on ranks other than 0. Whether it has kept its lines is
     * told by check_log(). */
    std::ostream &
    log()
    {
      return log_stream;
    }

    /** Throws FileError where lines of log.txt were lost. */
    void check_log();

    /** A row of monitors.csv. */
    void add_monitor(const MonitorRow &row);

    /** A row of probes.csv, on the rank 0. */
    void add_probes(const std::string &header, const std::string &row);

    /** A row of wall-forces.csv, on the rank 0. */
    void add_wall_forces(const std::string &header, const std::string &row);

    /** cases.csv, anew. */
    void write_cases(const std::vector<CaseResult> &cases);

    /** profiles-NN.csv of the flow case @p number, from 1 on, beside Ergun's pressure
     * where there is a bed. */
    void write_axial(const unsigned int number,
                     const CaseView    &flow,
                     const CaseResult  &result);

    /** radial-NN.csv; @p radius of the vessel [m]. */
    void write_radial(const unsigned int             number,
                      const std::vector<RegionMean> &profile,
                      const double                   radius);

    /** midplane-NN.csv; of means over time, averages-midplane-NN.csv. */
    void write_mid_plane(const unsigned int             number,
                         const std::vector<PlanePoint> &points,
                         const bool                     is_mean = false);

    /** The void fraction at @p points at @p time [s], behind earlier ones in
     * snapshots.csv. */
    void add_snapshot(const double                   time,
                      const unsigned int             number,
                      const std::vector<PlanePoint> &points);

    /** The tables of @p averages, whose statistics() are @p window, with NN of the flow
     * case @p number; none of what there is none of. */
    void write_averages(const unsigned int                   number,
                        const CaseAverages                  &averages,
                        const std::vector<SeriesStatistics> &window);

    /**
     * bed-axial.csv, bed-radial.csv, bed-janssen.csv, bed-coordination.csv and
     * bed-contacts.csv; nothing without a bed.
     */
    void write_bed(const BedProfiles &bed);

    /** Adds the fields at @p time [s] to solution.pvd or solution.xdmf. Collective. */
    void add_fields(const double time, const CoupledFlow &fluid);

    /** The same of a flow without particles. Collective. */
    void add_fields(const double      time,
                    const NodalSpace &nodes,
                    const Medium     &medium,
                    const FlowSolver &flow);

    /** Adds the means over time up to @p time [s] to averages.pvd or averages.xdmf.
     * Collective. */
    void add_averages(const double         time,
                      const NodalSpace    &nodes,
                      const FieldAverages &averages);

    /** Adds the particles at @p time [s] to particles.pvd. Collective. */
    void add_particles(const double time, const Dem &dem);

    /** Adds the contacts at @p time [s] to contacts.pvd. Collective. */
    void add_contacts(const double time, const Dem &dem);

    /** A file of the directory. */
    std::string path(const std::string &name) const;

  private:
    void open_log(const std::ios::openmode mode);
    // A file that rank 0 writes.
    void write(const std::string                         &name,
               const std::function<void(std::ostream &)> &write) const;
    // Writes the ParaView files of @p output, the next ones of @p records, whose names
    // begin with @p stem.
    template <class Output>
    void add_record(const double       time,
                    const std::string &stem,
                    const Output      &output,
                    Records           &records);
    void add_field_record(const double        time,
                          const std::string  &stem,
                          dealii::DataOut<3, 3> &output,
                          Records            &records);
    void write_table(const std::string &name, const std::string &text) const;
    void write_parameters(const dealii::ParameterHandler &prm);

    const std::string directory;
    const MPI_Comm    communicator;
    const bool        is_writer, in_hdf5;
    std::ofstream     log_stream;
    GrowingTable      monitors, probes, wall_forces, snapshots;
    Written           records;
  };
} // namespace graupel

#endif
