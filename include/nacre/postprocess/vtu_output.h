// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_postprocess_vtu_output_h
#define nacre_postprocess_vtu_output_h

#include <nacre/base/selection.h>
#include <nacre/postprocess/shell_state.h>

#include <deal.II/base/data_out_base.h>

#include <map>
#include <string>
#include <tuple>
#include <vector>

namespace Nacre
{
  /**
   * The fields of a solved shell on this rank's cells, at (p + 1)^2 equidistant
   * points of each: the nodes of VTK's Lagrange cells. A part of a divided cell
   * has such points on each of the quadrilaterals and triangles that make it
   * up (points_on_part()), so that cuts open, and so has the cell in which a
   * tip with functions lies. Stresses are those of each cell by itself, not
   * smoothed. deal.II's writers of all formats work on it.
   *
   * | field | meaning | units |
   * |---|---|---|
   * | displacement | u | length |
   * | normal | t0, of the undeformed surface | - |
   * | e1, e2 | surface frame: e1 = a_1/|a_1|, e2 = t0 x e1 | - |
   * | membrane_forces | N = n^ab a_a (x) a_b | force/length |
   * | moments | M = m^ab a_a (x) a_b | force |
   * | principal_membrane_force_1, _2 | eigenvalues in the tangent plane, the
   * larger first | force/length |
   * | principal_moment_1, _2 | the same of M | force |
   * | n11, n22, n12, m11, m22, m12 | e_i . N e_j, e_i . M e_j | |
   * | von_mises_top, _middle, _bottom | of the plane stress of the section law,
   * n/h + 12 z m/h^3 if it is homogeneous, at z = h/2, 0, -h/2 along t0 from
   * its middle | force/length^2 |
   * | energy_density | w of the section law | force/length |
   * | accumulated_plastic_strain_top, _middle, _bottom | of metals:
   * SectionLaw::state_results(), their names with _ for spaces | - |
   * | rank | MPI rank that owns the cell | - |
   * | tsai_wu, maximum_stress | of laminates: the largest index of all plies, 1
   * at failure; 0 without strengths | - |
   * | ply_K_bottom_stress, ply_K_top_stress | of laminates: (s1, s2, t12) of
   * the ply K, counted from 1 at the bottom, in its axes | force/length^2 |
   * | ply_K_bottom_strain, ply_K_top_strain | (e1, e2, 2 e12) there | - |
   * | error_indicator | eta_K of the cell, if given | |
   * | mode | of a point of a path, if given: its largest entry is 1 | - |
   *
   * The strain at the distance z along t0 is eps + z rho, since
   * rho_ab = -u,ab . t0 on a plate: positive moments stretch the top.
   */
  class ShellFields : public DataOutInterface<dim, spacedim>
  {
  public:
    using Patch = DataOutBase::Patch<dim, spacedim>;
    using NonscalarRange =
      std::tuple<unsigned int,
                 unsigned int,
                 std::string,
                 DataComponentInterpretation::DataComponentInterpretation>;

    /**
     * @param error_indicators by active cell index, if any
     * @param n_subdivisions of each quadrilateral's edges; 0: the degree p
     * @param mode a field of displacements, ghosted, or null
     */
    ShellFields(const ShellState                    &state,
                const std::vector<double>           &error_indicators = {},
                const unsigned int                   n_subdivisions   = 0,
                const TrilinosWrappers::MPI::Vector *mode = nullptr);

    /**
     * One patch for each of this rank's cells, of a part one or more;
     * data[component][point], points in lexicographic order, the three last
     * components are the position.
     */
    const std::vector<Patch> &
    get_patches() const override;

    /** The name of each component; those of a vector or tensor share one. */
    std::vector<std::string>
    get_dataset_names() const override;

    std::vector<NonscalarRange>
    get_nonscalar_data_ranges() const override;

  private:
    unsigned int             n_layers_;
    std::vector<std::string> state_results_;
    bool                     has_error_indicators_;
    bool                     has_mode_;
    std::vector<Patch>       patches_;
  };

  /** Kinds of files for the fields. */
  enum class FieldFormat
  {
    vtu,
    hdf5
  };

  const Selection<FieldFormat> &selection(FieldFormat);

  /**
   * What has been written for each counter: its time, and the file or the
   * piece of XML that the list of all times shows.
   */
  using FieldRecords = std::map<unsigned int, std::pair<double, std::string>>;

  /**
   * Writes ShellFields, one time step per solve or per step of a path.
   *
   * | format | cells | files | list of times |
   * |---|---|---|---|
   * | vtu | higher-order | `NAME_LABEL.vtu`, or `NAME_LABEL.GROUP.vtu` for
   * each group of ranks that owns cells, and `NAME_LABEL.pvtu` | `NAME.pvd` |
   * | hdf5 | linear, p x p for each | `NAME_LABEL.h5` | `NAME.xdmf` |
   *
   * The label tells what a file holds; by default it is the counter. The
   * files of ThickFields are always .vtu, `NAME_thick_LABEL.vtu`, listed by
   * `NAME_thick.pvd`; `NAME_cuts.vtu` holds the cuts of the mesh that was
   * written last, as lines.
   *
   * In ParaView open the list and use "Warp By Vector" with the displacement.
   */
  class VtuOutput
  {
  public:
    struct Options
    {
      FieldFormat format = FieldFormat::vtu;
      /** The ranks of a group, whose cells share a .vtu. */
      unsigned int ranks_per_file = 16;
      /** Of each quadrilateral's edges; 0: the degree p. */
      unsigned int n_subdivisions = 0;
      /** Whether ThickFields are written too. */
      bool thick = false;
    };

    VtuOutput() = default;

    explicit VtuOutput(const Options &options)
      : options_(options)
    {}

    /** What the files of a solve or a step are called and listed as. */
    struct Entry
    {
      /** Not explicit: the number of a solve says it all. */
      Entry(const unsigned int counter)
        : Entry(counter, counter, std::to_string(counter))
      {}

      Entry(const unsigned int counter,
            const double       time,
            const std::string &label)
        : counter(counter)
        , time(time)
        , label(label)
      {}

      unsigned int counter;
      /** That the list tells of. */
      double      time;
      std::string label;
      /** The list's name is that of the files, and this. */
      std::string list = "";
      /** A mode that is shown beside the state, ghosted, or null. */
      const TrilinosWrappers::MPI::Vector *mode = nullptr;
    };

    /**
     * Write the files of @p entry into @p folder, which is created if it is
     * missing, and the list of all counters written so far by this object.
     * Collective; throws on all ranks an ExcMessage that names the folder or
     * file if one can't be written.
     */
    void
    write(const ShellState          &state,
          const std::string         &folder,
          const std::string         &name,
          const Entry               &entry,
          const std::vector<double> &error_indicators = {});

    /** What has been written under this name. */
    const FieldRecords &
    records(const std::string &folder, const std::string &name);

    /** Go on with the list of what an earlier run has @p written. */
    void
    resume(const std::string  &folder,
           const std::string  &name,
           const FieldRecords &written);

  private:
    /** The bodies' files, beside those of an entry. */
    void
    write_thick(const ShellState  &state,
                const std::string &folder,
                const std::string &name,
                const Entry       &entry);

    const Options options_;
    /** By folder and name. */
    std::map<std::string, FieldRecords> records_;
  };
} // namespace Nacre

#endif
