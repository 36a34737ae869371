// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/mpi_errors.h>
#include <nacre/base/output_file.h>
#include <nacre/postprocess/cut_output.h>
#include <nacre/postprocess/hdf5_output.h>
#include <nacre/postprocess/point_results.h>
#include <nacre/postprocess/thick_fields.h>
#include <nacre/postprocess/vtu_output.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <sstream>
#include <type_traits>

namespace Nacre
{
  const Selection<FieldFormat> &
  selection(FieldFormat)
  {
    static const Selection<FieldFormat> table = {{FieldFormat::vtu, "vtu"},
                                                 {FieldFormat::hdf5, "hdf5"}};
    return table;
  }

  namespace
  {
    namespace Interpretation = DataComponentInterpretation;
    using Vector3            = Tensor<1, spacedim>;
    using Tensor3            = Tensor<2, spacedim>;

    /** The largest of an index of all layers; 0 without any. */
    double
    largest(const PointResults         &s,
            const std::optional<double> LayerState::*index)
    {
      std::optional<double> largest;
      for (const auto &layer : s.layers)
        if (layer.*index)
          largest =
            largest ? std::max(*largest, *(layer.*index)) : layer.*index;
      return largest.value_or(0.);
    }

    /** Of a layer's face, as a vector; 0 where there is no such layer. */
    Vector3
    of_layer(const PointResults          &s,
             const std::array<Voigt<>, 2> LayerState::*values,
             const unsigned int                        layer,
             const unsigned int                        face)
    {
      return layer < s.layers.size() ? (s.layers[layer].*values)[face] :
                                       Vector3();
    }

    /** A field of the output: name, rank, and how to compute it. */
    struct OutputField
    {
      std::string                                 name;
      Interpretation::DataComponentInterpretation interpretation;
      unsigned int                                n_components;
      std::function<double(const PointResults &, const unsigned int)> component;
    };

    OutputField
    scalar(const std::string                                 &name,
           const std::function<double(const PointResults &)> &value)
    {
      return {name,
              Interpretation::component_is_scalar,
              1,
              [value](const PointResults &s, const unsigned int) {
                return value(s);
              }};
    }

    OutputField
    vector(const std::string                                  &name,
           const std::function<Vector3(const PointResults &)> &value)
    {
      return {name,
              Interpretation::component_is_part_of_vector,
              spacedim,
              [value](const PointResults &s, const unsigned int c) {
                return value(s)[c];
              }};
    }

    OutputField
    tensor(const std::string                                  &name,
           const std::function<Tensor3(const PointResults &)> &value)
    {
      return {name,
              Interpretation::component_is_part_of_tensor,
              Tensor3::n_independent_components,
              [value](const PointResults &s, const unsigned int c) {
                return value(s)[Tensor3::unrolled_to_component_indices(c)];
              }};
    }

    /** The fields of @p n_layers layers. */
    std::vector<OutputField>
    layer_fields(const unsigned int n_layers)
    {
      using S                       = const PointResults &;
      std::vector<OutputField> list = {
        scalar("tsai_wu", [](S s) { return largest(s, &LayerState::tsai_wu); }),
        scalar("maximum_stress",
               [](S s) { return largest(s, &LayerState::maximum_stress); })};
      for (unsigned int k = 0; k < n_layers; ++k)
        for (unsigned int face = 0; face < 2; ++face)
          {
            const std::string name = "ply_" + std::to_string(k + 1) +
                                     (face == 0 ? "_bottom_" : "_top_");
            list.push_back(vector(name + "stress", [=](S s) {
              return of_layer(s, &LayerState::stress, k, face);
            }));
            list.push_back(vector(name + "strain", [=](S s) {
              return of_layer(s, &LayerState::strain, k, face);
            }));
          }
      return list;
    }

    /** The components of a tensor of the tangent plane, NAME11, 22, 12. */
    void
    add_components(const std::string                                  &name,
                   const std::function<Tensor3(const PointResults &)> &value,
                   std::vector<OutputField>                           &list)
    {
      for (const auto &[i, j] :
           {std::pair<unsigned int, unsigned int>{0, 0}, {1, 1}, {0, 1}})
        list.push_back(
          scalar(name + std::to_string(i + 1) + std::to_string(j + 1),
                 [=, i = i, j = j](const PointResults &s) {
                   return s.e[i] * (value(s) * s.e[j]);
                 }));
    }

    /** The principal values of a tensor, NAME_1_ENDING and NAME_2_ENDING. */
    void
    add_principal_values(
      const std::string                                  &name,
      const std::string                                  &ending,
      const std::function<Tensor3(const PointResults &)> &value,
      std::vector<OutputField>                           &list)
    {
      for (unsigned int i = 0; i < dim; ++i)
        list.push_back(scalar(name + "_" + std::to_string(i + 1) + ending,
                              [=](const PointResults &s) {
                                return s.principal(value(s))[i].value;
                              }));
    }

    /** Stresses at the faces. */
    std::vector<OutputField>
    stress_fields()
    {
      using S = const PointResults &;
      std::vector<OutputField> list;
      for (const Face face : {Face::top, Face::middle, Face::bottom})
        list.push_back(scalar("von_mises_" + name_of(face),
                              [=](S s) { return s.von_mises(face); }));
      for (const Face face : {Face::top, Face::middle, Face::bottom})
        {
          const auto stress = [=](S s) {
            return s.stress[static_cast<unsigned int>(face)];
          };
          const std::string ending = "_" + name_of(face);
          add_principal_values("principal_stress", ending, stress, list);
          for (unsigned int i = 0; i < dim; ++i)
            list.push_back(
              vector("principal_direction_" + std::to_string(i + 1) + ending,
                     [=](S s) { return s.principal(stress(s))[i].direction; }));
        }
      return list;
    }

    /** What the section remembers at the faces, by the names of its results. */
    std::vector<OutputField>
    state_fields(const std::vector<std::string> &names)
    {
      std::vector<OutputField> list;
      for (unsigned int k = 0; k < names.size(); ++k)
        for (const Face face : {Face::top, Face::middle, Face::bottom})
          list.push_back(scalar(field_name(names[k]) + "_" + name_of(face),
                                [=](const PointResults &s) {
                                  const auto f = static_cast<unsigned>(face);
                                  return s.state_results[f][k];
                                }));
      return list;
    }

    /** All fields of the output, in its order. */
    std::vector<OutputField>
    fields(const unsigned int              n_layers,
           const std::vector<std::string> &state_results)
    {
      using S            = const PointResults &;
      const auto forces  = [](S s) { return s.membrane_forces; };
      const auto moments = [](S s) { return s.moments; };

      std::vector<OutputField> list = {
        vector("displacement", [](S s) { return s.displacement; }),
        vector("normal", [](S s) { return s.normal; }),
        vector("e1", [](S s) { return s.e[0]; }),
        vector("e2", [](S s) { return s.e[1]; }),
        tensor("membrane_forces", forces),
        tensor("moments", moments)};
      add_principal_values("principal_membrane_force", "", forces, list);
      add_principal_values("principal_moment", "", moments, list);
      add_components("n", forces, list);
      add_components("m", moments, list);
      list.push_back(
        vector("transverse_shear", [](S s) { return s.transverse_shear; }));
      for (unsigned int i = 0; i < dim; ++i)
        list.push_back(scalar("q" + std::to_string(i + 1), [=](S s) {
          return s.e[i] * s.transverse_shear;
        }));
      for (const auto &field : stress_fields())
        list.push_back(field);
      list.push_back(
        scalar("energy_density", [](S s) { return s.energy_density; }));
      for (const auto &field : state_fields(state_results))
        list.push_back(field);
      if (n_layers > 0)
        for (const auto &field : layer_fields(n_layers))
          list.push_back(field);
      return list;
    }

    DataOutBase::VtkFlags
    output_flags()
    {
      DataOutBase::VtkFlags flags;
      flags.print_date_and_time = false;
      flags.compression_level   = DataOutBase::VtkFlags::default_compression;
      flags.write_higher_order_cells = true;
      return flags;
    }

    std::string
    path_of(const std::string &folder, const std::string &name)
    {
      return (std::filesystem::path(folder) / name).string();
    }

    /** What one write() needs to know of the ranks. */
    struct Groups
    {
      Groups(const Discretization &discretization,
             const unsigned int    ranks_per_file)
        : communicator(discretization.communicator())
        , size(ranks_per_file)
        , n_cells(Utilities::MPI::all_gather(
            communicator,
            discretization.triangulation().n_locally_owned_active_cells()))
        , rank(Utilities::MPI::this_mpi_process(communicator))
      {}

      unsigned int
      n() const
      {
        return (n_cells.size() + size - 1) / size;
      }

      bool
      has_cells(const unsigned int group) const
      {
        const auto begin = n_cells.begin() + group * size;
        const auto end =
          n_cells.begin() +
          std::min<std::size_t>((group + 1) * size, n_cells.size());
        return std::any_of(begin, end, [](const auto n) { return n > 0; });
      }

      std::string
      file(const std::string &base, const unsigned int group) const
      {
        return n() == 1 ? base + ".vtu" :
                          base + "." + std::to_string(group) + ".vtu";
      }

      const MPI_Comm                  communicator;
      const unsigned int              size;
      const std::vector<unsigned int> n_cells;
      const unsigned int              rank;
    };

    /**
     * The cells of each group go through its first rank into one file: no
     * parallel file system is needed.
     * @return the file that holds or lists all cells
     */
    template <typename Fields>
    std::string
    write_vtu_files(const Fields      &fields,
                    const Groups      &groups,
                    const std::string &folder,
                    const std::string &base)
    {
      // Volume cells are linear.
      DataOutBase::VtkFlags flags    = output_flags();
      flags.write_higher_order_cells = std::is_same_v<Fields, ShellFields>;
      std::map<unsigned int, std::string> mine;
      if (groups.n_cells[groups.rank] > 0)
        {
          std::ostringstream piece;
          DataOutBase::write_vtu_main(fields.get_patches(),
                                      fields.get_dataset_names(),
                                      fields.get_nonscalar_data_ranges(),
                                      flags,
                                      piece);
          mine[groups.rank - groups.rank % groups.size] = piece.str();
        }
      const auto pieces =
        Utilities::MPI::some_to_some(groups.communicator, mine);
      run_on_all_ranks(groups.communicator, [&] {
        if (pieces.empty())
          return;
        const auto file = groups.file(base, groups.rank / groups.size);
        write_file(path_of(folder, file), [&](std::ostream &out) {
          DataOutBase::write_vtu_header(out, flags);
          for (const auto &piece : pieces)
            out << piece.second;
          DataOutBase::write_vtu_footer(out);
        });
      });
      if (groups.n() == 1)
        return groups.file(base, 0);

      const std::string record = base + ".pvtu";
      run_on_root(groups.communicator, [&] {
        std::vector<std::string> files;
        for (unsigned int group = 0; group < groups.n(); ++group)
          if (groups.has_cells(group))
            files.push_back(groups.file(base, group));
        write_file(path_of(folder, record), [&](std::ostream &out) {
          fields.write_pvtu_record(out, files);
        });
      });
      return record;
    }

    /** The list of all times. */
    void
    write_pvd(const MPI_Comm      communicator,
              const std::string  &base,
              const FieldRecords &records)
    {
      run_on_root(communicator, [&] {
        std::vector<std::pair<double, std::string>> times;
        for (const auto &record : records)
          times.push_back(record.second);
        write_file(base + ".pvd", [&](std::ostream &out) {
          DataOutBase::write_pvd_record(out, times);
        });
      });
    }
  } // namespace


  ShellFields::ShellFields(const ShellState          &state,
                           const std::vector<double> &error_indicators,
                           const unsigned int         n_subdivisions,
                           const TrilinosWrappers::MPI::Vector *mode)
    : n_layers_(state.model.section->n_layers())
    , state_results_(state.model.section->state_result_names())
    , has_error_indicators_(!error_indicators.empty())
    , has_mode_(mode != nullptr)
  {
    const Discretization &discretization = state.discretization;
    const bool            triangles =
      discretization.element().type == ElementType::triangle;
    const unsigned int n = (triangles || n_subdivisions == 0) ?
                             discretization.degree() :
                             n_subdivisions;
    // Points of a patch: a lexicographic grid, or the nodes of a triangle.
    const Quadrature<dim> points =
      triangles ?
        Quadrature<dim>(discretization.scalar_fe().get_unit_support_points()) :
        Quadrature<dim>(QIterated<dim>(QTrapezoid<1>(), n));
    CellResults                 results(state, points, true, true);
    const ShellState            moved{discretization,
                           state.model,
                           has_mode_ ? *mode : state.displacement};
    std::optional<StrainValues> mode_values;
    if (has_mode_)
      mode_values.emplace(moved, points, true);
    const auto                      list = fields(n_layers_, state_results_);
    const std::vector<unsigned int> corners =
      triangles ?
        std::vector<unsigned int>{0, 1, 2} :
        std::vector<unsigned int>{0, n, n * (n + 1), points.size() - 1};
    const double rank =
      Utilities::MPI::this_mpi_process(discretization.communicator());
    Patch patch;
    patch.reference_cell       = discretization.element().reference_cell();
    patch.n_subdivisions       = n;
    patch.points_are_available = true;
    patch.data.reinit(get_dataset_names().size() + spacedim, points.size());
    for (const CellPart &part : discretization.owned_parts())
      {
        results.reinit(part);
        if (has_mode_)
          mode_values->reinit(part);
        // Parts of divided cells have several lattices of points.
        for (unsigned int first = 0; first < results.n_points();
             first += points.size())
          {
            for (unsigned int q = first; q < first + points.size(); ++q)
              {
                const PointResults  here = results.at(q);
                std::vector<double> column;
                for (const auto &field : list)
                  for (unsigned int c = 0; c < field.n_components; ++c)
                    column.push_back(field.component(here, c));
                column.push_back(rank);
                if (has_error_indicators_)
                  column.push_back(
                    error_indicators[part.cell->active_cell_index()]);
                for (unsigned int c = 0; c < (has_mode_ ? spacedim : 0); ++c)
                  column.push_back(mode_values->displacement(q)[c]);
                for (unsigned int c = 0; c < spacedim; ++c)
                  column.push_back(results.position(q)[c]);
                for (unsigned int row = 0; row < column.size(); ++row)
                  patch.data(row, q - first) = column[row];
              }
            for (unsigned int vertex = 0; vertex < corners.size(); ++vertex)
              patch.vertices[vertex] =
                results.position(first + corners[vertex]);
            patch.patch_index = patches_.size();
            patches_.push_back(patch);
          }
      }

    this->set_flags(output_flags());
  }


  const std::vector<ShellFields::Patch> &
  ShellFields::get_patches() const
  {
    return patches_;
  }


  std::vector<std::string>
  ShellFields::get_dataset_names() const
  {
    std::vector<std::string> names;
    for (const auto &field : fields(n_layers_, state_results_))
      names.insert(names.end(), field.n_components, field.name);
    names.push_back("rank");
    if (has_error_indicators_)
      names.push_back("error_indicator");
    if (has_mode_)
      names.insert(names.end(), spacedim, "mode");
    return names;
  }


  std::vector<ShellFields::NonscalarRange>
  ShellFields::get_nonscalar_data_ranges() const
  {
    std::vector<NonscalarRange> ranges;
    unsigned int                first = 0;
    for (const auto &field : fields(n_layers_, state_results_))
      {
        if (field.interpretation != Interpretation::component_is_scalar)
          ranges.emplace_back(first,
                              first + field.n_components - 1,
                              field.name,
                              field.interpretation);
        first += field.n_components;
      }
    first += has_error_indicators_ ? 2 : 1;
    if (has_mode_)
      ranges.emplace_back(first,
                          first + spacedim - 1,
                          "mode",
                          Interpretation::component_is_part_of_vector);
    return ranges;
  }


  const FieldRecords &
  VtuOutput::records(const std::string &folder, const std::string &name)
  {
    return records_[path_of(folder, name)];
  }


  void
  VtuOutput::resume(const std::string  &folder,
                    const std::string  &name,
                    const FieldRecords &written)
  {
    records_[path_of(folder, name)] = written;
    if (!options_.thick)
      return;
    // Of the bodies' files those that are there.
    const std::string base = name + "_thick";
    for (const auto &[counter, record] : written)
      for (const auto *const ending : {".vtu", ".pvtu"})
        {
          const std::string file =
            base + "_" + std::to_string(counter) + ending;
          if (std::filesystem::exists(path_of(folder, file)))
            records_[path_of(folder, base)][counter] = {record.first, file};
        }
  }


  void
  VtuOutput::write(const ShellState          &state,
                   const std::string         &folder,
                   const std::string         &name,
                   const Entry               &entry,
                   const std::vector<double> &error_indicators)
  {
    const Discretization &discretization = state.discretization;
    const MPI_Comm        communicator   = discretization.communicator();
    run_on_root(communicator, [&] { create_folder(folder); });
    std::unique_ptr<ShellFields> fields;
    run_on_all_ranks(communicator, [&] {
      fields = std::make_unique<ShellFields>(state,
                                             error_indicators,
                                             options_.n_subdivisions,
                                             entry.mode);
    });
    const std::string base    = name + "_" + entry.label;
    const std::string all     = path_of(folder, name + entry.list);
    const bool        is_hdf5 = (options_.format == FieldFormat::hdf5);
    FieldRecords     &records = records_[all];
    records[entry.counter]    = {
         entry.time,
      is_hdf5 ? write_hdf5(*fields,
                           communicator,
                           discretization.element().reference_cell(),
                           folder,
                           base,
                           entry.time) :
                   write_vtu_files(*fields,
                                Groups(discretization, options_.ranks_per_file),
                                folder,
                                base)};
    if (options_.thick)
      write_thick(state, folder, name, entry);
    write_cut_lines(discretization, path_of(folder, name + "_cuts"));
    if (!is_hdf5)
      return write_pvd(communicator, all, records);
    run_on_root(communicator, [&] {
      write_file(all + ".xdmf",
                 [&](std::ostream &out) { write_xdmf(out, records); });
    });
  }

  void
  VtuOutput::write_thick(const ShellState  &state,
                         const std::string &folder,
                         const std::string &name,
                         const Entry       &entry)
  {
    const MPI_Comm communicator = state.discretization.communicator();
    std::unique_ptr<ThickFields> fields;
    run_on_all_ranks(communicator, [&] {
      fields = std::make_unique<ThickFields>(state, options_.n_subdivisions);
    });
    const std::string base    = name + "_thick";
    const std::string all     = path_of(folder, base + entry.list);
    FieldRecords     &records = records_[all];
    records[entry.counter]    = {entry.time,
                                 write_vtu_files(*fields,
                                              Groups(state.discretization,
                                                     options_.ranks_per_file),
                                              folder,
                                              base + "_" + entry.label)};
    write_pvd(communicator, all, records);
  }
} // namespace Nacre
