// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_postprocess_thick_fields_h
#define nacre_postprocess_thick_fields_h

#include <nacre/postprocess/shell_state.h>

#include <deal.II/base/data_out_base.h>

#include <string>
#include <tuple>
#include <vector>

namespace Nacre
{
  /**
   * A solved shell as the body that it stands for, for pictures: the cells of
   * this rank, cut into linear ones and extruded from the bottom to the top,
   * hexahedra or wedges; one layer, or one for each ply of a laminate.
   *
   * | field | meaning | units |
   * |---|---|---|
   * | displacement | u + z (t - t0), z above the mid-surface | length |
   * | stress | of the section law there, a tensor of space | force/length^2 |
   * | principal_stress_1, _2 | its eigenvalues in the tangent plane, the larger
   * first | force/length^2 |
   * | von_mises | | force/length^2 |
   * | layer | number of the ply, from 1 at the bottom of the stack | - |
   * | accumulated_plastic_strain | of metals: SectionLaw::state_results() | - |
   */
  class ThickFields : public DataOutInterface<3, spacedim>
  {
  public:
    using Patch = DataOutBase::Patch<3, spacedim>;
    using NonscalarRange =
      std::tuple<unsigned int,
                 unsigned int,
                 std::string,
                 DataComponentInterpretation::DataComponentInterpretation>;

    /** @param n_subdivisions of each cell's edges; 0: the degree p */
    ThickFields(const ShellState &state, const unsigned int n_subdivisions);

    /** One patch for each linear cell; data[component][vertex]. */
    const std::vector<Patch> &
    get_patches() const override
    {
      return patches_;
    }

    std::vector<std::string>
    get_dataset_names() const override;

    std::vector<NonscalarRange>
    get_nonscalar_data_ranges() const override;

  private:
    std::vector<std::string> state_results_;
    std::vector<Patch>       patches_;
  };
} // namespace Nacre

#endif
