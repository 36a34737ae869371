// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/mpi_errors.h>
#include <nacre/base/output_file.h>
#include <nacre/mechanics/shell_strain.h>
#include <nacre/postprocess/hdf5_output.h>
#include <nacre/postprocess/strain_values.h>
#include <nacre/postprocess/vtu_output.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/base/symmetric_tensor.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <functional>
#include <memory>
#include <sstream>

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
    using PlaneTensor        = SymmetricTensor<2, dim>;

    /** The solution at one point. */
    struct PointState
    {
      Vector3 displacement;
      Vector3 normal;
      /** Orthonormal basis of the tangent plane. */
      std::array<Vector3, dim> e;
      /** Membrane forces and moments in space and in the basis e. */
      Tensor3     membrane_forces, moments;
      PlaneTensor n, m;
      /** At the top, in the middle, at the bottom. */
      std::array<double, 3> von_mises{};
      double                energy_density = 0.;
      double                rank           = 0.;
      /** Of laminates, bottom to top. */
      std::vector<LayerState> layers;

      /** The largest of an index of all layers; 0 without any. */
      double
      largest(const std::optional<double> LayerState::*index) const
      {
        std::optional<double> largest;
        for (const auto &layer : layers)
          if (layer.*index)
            largest =
              largest ? std::max(*largest, *(layer.*index)) : layer.*index;
        return largest.value_or(0.);
      }

      /** Of a layer's face, as a vector; 0 where there is no such layer. */
      Vector3
      of_layer(const std::array<Voigt<>, 2> LayerState::*values,
               const unsigned int                        layer,
               const unsigned int                        face) const
      {
        return layer < layers.size() ? (layers[layer].*values)[face] :
                                       Vector3();
      }
    };

    /** s11^2 - s11 s22 + s22^2 + 3 s12^2, its root. */
    double
    von_mises(const PlaneTensor &stress)
    {
      const double trace = stress[0][0] + stress[1][1];
      const double det =
        stress[0][0] * stress[1][1] - stress[0][1] * stress[0][1];
      return std::sqrt(std::max(trace * trace - 3. * det, 0.));
    }

    /** A field of the output: name, rank, and how to compute it. */
    struct OutputField
    {
      std::string                                 name;
      Interpretation::DataComponentInterpretation interpretation;
      unsigned int                                n_components;
      std::function<double(const PointState &, const unsigned int)> component;
    };

    OutputField
    scalar(const std::string                               &name,
           const std::function<double(const PointState &)> &value)
    {
      return {name,
              Interpretation::component_is_scalar,
              1,
              [value](const PointState &s, const unsigned int) {
                return value(s);
              }};
    }

    OutputField
    vector(const std::string                                &name,
           const std::function<Vector3(const PointState &)> &value)
    {
      return {name,
              Interpretation::component_is_part_of_vector,
              spacedim,
              [value](const PointState &s, const unsigned int c) {
                return value(s)[c];
              }};
    }

    OutputField
    tensor(const std::string                                &name,
           const std::function<Tensor3(const PointState &)> &value)
    {
      return {name,
              Interpretation::component_is_part_of_tensor,
              Tensor3::n_independent_components,
              [value](const PointState &s, const unsigned int c) {
                return value(s)[Tensor3::unrolled_to_component_indices(c)];
              }};
    }

    /** The fields of @p n_layers layers. */
    std::vector<OutputField>
    layer_fields(const unsigned int n_layers)
    {
      using S                       = const PointState &;
      std::vector<OutputField> list = {
        scalar("tsai_wu", [](S s) { return s.largest(&LayerState::tsai_wu); }),
        scalar("maximum_stress",
               [](S s) { return s.largest(&LayerState::maximum_stress); })};
      for (unsigned int k = 0; k < n_layers; ++k)
        for (unsigned int face = 0; face < 2; ++face)
          {
            const std::string name = "ply_" + std::to_string(k + 1) +
                                     (face == 0 ? "_bottom_" : "_top_");
            list.push_back(vector(name + "stress", [=](S s) {
              return s.of_layer(&LayerState::stress, k, face);
            }));
            list.push_back(vector(name + "strain", [=](S s) {
              return s.of_layer(&LayerState::strain, k, face);
            }));
          }
      return list;
    }

    /** All fields of the output, in its order. */
    std::vector<OutputField>
    fields(const unsigned int n_layers)
    {
      using S                       = const PointState &;
      std::vector<OutputField> list = {
        vector("displacement", [](S s) { return s.displacement; }),
        vector("normal", [](S s) { return s.normal; }),
        vector("e1", [](S s) { return s.e[0]; }),
        vector("e2", [](S s) { return s.e[1]; }),
        tensor("membrane_forces", [](S s) { return s.membrane_forces; }),
        tensor("moments", [](S s) { return s.moments; }),
        scalar("principal_membrane_force_1",
               [](S s) { return eigenvalues(s.n)[0]; }),
        scalar("principal_membrane_force_2",
               [](S s) { return eigenvalues(s.n)[1]; }),
        scalar("principal_moment_1", [](S s) { return eigenvalues(s.m)[0]; }),
        scalar("principal_moment_2", [](S s) { return eigenvalues(s.m)[1]; }),
        scalar("n11", [](S s) { return s.n[0][0]; }),
        scalar("n22", [](S s) { return s.n[1][1]; }),
        scalar("n12", [](S s) { return s.n[0][1]; }),
        scalar("m11", [](S s) { return s.m[0][0]; }),
        scalar("m22", [](S s) { return s.m[1][1]; }),
        scalar("m12", [](S s) { return s.m[0][1]; }),
        scalar("von_mises_top", [](S s) { return s.von_mises[0]; }),
        scalar("von_mises_middle", [](S s) { return s.von_mises[1]; }),
        scalar("von_mises_bottom", [](S s) { return s.von_mises[2]; }),
        scalar("energy_density", [](S s) { return s.energy_density; }),
        scalar("rank", [](S s) { return s.rank; })};
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

    /** Components e_i . T e_j of a tensor of the tangent plane. */
    PlaneTensor
    in_basis(const std::array<Vector3, dim> &e, const Tensor3 &T)
    {
      PlaneTensor plane;
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = i; j < dim; ++j)
          plane[i][j] = e[i] * (T * e[j]);
      return plane;
    }

    /** The state at the points of one cell after the other. */
    class CellStates
    {
    public:
      CellStates(const Discretization                &discretization,
                 const SectionLaw                    &section,
                 const Quadrature<dim>               &points,
                 const KinematicsOptions             &kinematics,
                 const TrilinosWrappers::MPI::Vector &displacement)
        : section_(section)
        , rank_(Utilities::MPI::this_mpi_process(discretization.communicator()))
        , strains_(discretization, points, kinematics, displacement)
      {}

      void
      reinit(const DoFHandler<dim, spacedim>::active_cell_iterator &cell)
      {
        strains_.reinit(cell);
      }

      Point<spacedim>
      position(const unsigned int q) const
      {
        return strains_.values().point(q);
      }

      PointState
      state(const unsigned int q) const
      {
        const auto &frame  = strains_.values().frame(q);
        const auto  point  = strains_.values().point(q);
        const auto  eps    = strains_.membrane(q);
        const auto  rho    = strains_.bending(q);
        const auto  answer = section_.response(eps, rho, frame, point);

        PointState s;
        s.displacement   = strains_.displacement(q);
        s.normal         = frame.t0;
        s.e[0]           = frame.a_cov[0] / frame.a_cov[0].norm();
        s.e[1]           = cross_product_3d(frame.t0, s.e[0]);
        s.rank           = rank_;
        s.energy_density = answer.energy;
        s.membrane_forces =
          ShellStrain::resultant_tensor(frame, answer.membrane_force);
        s.moments = ShellStrain::resultant_tensor(frame, answer.moment);
        s.n       = in_basis(s.e, s.membrane_forces);
        s.m       = in_basis(s.e, s.moments);
        for (unsigned int k = 0; k < 3; ++k)
          s.von_mises[k] = von_mises(
            in_basis(s.e,
                     ShellStrain::resultant_tensor(
                       frame,
                       section_.stress(eps, rho, 1. - k, frame, point))));
        s.layers = section_.layers(eps, rho, frame, point);
        return s;
      }

    private:
      const SectionLaw  &section_;
      const unsigned int rank_;
      StrainValues       strains_;
    };

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
    std::string
    write_vtu_files(const ShellFields &fields,
                    const Groups      &groups,
                    const std::string &folder,
                    const std::string &base)
    {
      std::map<unsigned int, std::string> mine;
      if (groups.n_cells[groups.rank] > 0)
        {
          std::ostringstream piece;
          DataOutBase::write_vtu_main(fields.get_patches(),
                                      fields.get_dataset_names(),
                                      fields.get_nonscalar_data_ranges(),
                                      output_flags(),
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
          DataOutBase::write_vtu_header(out, output_flags());
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
  } // namespace


  ShellFields::ShellFields(const Discretization                &discretization,
                           const SectionLaw                    &section,
                           const KinematicsOptions             &kinematics,
                           const TrilinosWrappers::MPI::Vector &displacement,
                           const std::vector<double> &error_indicators,
                           const unsigned int         n_subdivisions)
    : n_layers_(section.n_layers())
    , has_error_indicators_(!error_indicators.empty())
  {
    const bool triangles =
      discretization.element().type == ElementType::triangle;
    const unsigned int n = (triangles || n_subdivisions == 0) ?
                             discretization.degree() :
                             n_subdivisions;
    // Points of a patch: a lexicographic grid, or the nodes of a triangle.
    const Quadrature<dim> points =
      triangles ?
        Quadrature<dim>(discretization.scalar_fe().get_unit_support_points()) :
        Quadrature<dim>(QIterated<dim>(QTrapezoid<1>(), n));
    CellStates         states(discretization,
                      section,
                      points,
                      kinematics,
                      displacement);
    const auto         list         = fields(n_layers_);
    const unsigned int n_components = get_dataset_names().size();

    for (const auto &cell :
         discretization.dof_handler().active_cell_iterators())
      if (cell->is_locally_owned())
        {
          states.reinit(cell);
          Patch patch;
          patch.patch_index          = patches_.size();
          patch.reference_cell       = cell->reference_cell();
          patch.n_subdivisions       = n;
          patch.points_are_available = true;
          patch.data.reinit(n_components + spacedim, points.size());
          for (unsigned int q = 0; q < points.size(); ++q)
            {
              const PointState state = states.state(q);
              unsigned int     row   = 0;
              for (const auto &field : list)
                for (unsigned int c = 0; c < field.n_components; ++c)
                  patch.data(row++, q) = field.component(state, c);
              if (has_error_indicators_)
                patch.data(row++, q) =
                  error_indicators[cell->active_cell_index()];
              for (unsigned int c = 0; c < spacedim; ++c)
                patch.data(row++, q) = states.position(q)[c];
            }
          const std::vector<unsigned int> corners =
            triangles ?
              std::vector<unsigned int>{0, 1, 2} :
              std::vector<unsigned int>{0, n, n * (n + 1), points.size() - 1};
          for (unsigned int vertex = 0; vertex < corners.size(); ++vertex)
            patch.vertices[vertex] = states.position(corners[vertex]);
          patches_.push_back(std::move(patch));
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
    for (const auto &field : fields(n_layers_))
      names.insert(names.end(), field.n_components, field.name);
    if (has_error_indicators_)
      names.push_back("error_indicator");
    return names;
  }


  std::vector<ShellFields::NonscalarRange>
  ShellFields::get_nonscalar_data_ranges() const
  {
    std::vector<NonscalarRange> ranges;
    unsigned int                first = 0;
    for (const auto &field : fields(n_layers_))
      {
        if (field.interpretation != Interpretation::component_is_scalar)
          ranges.emplace_back(first,
                              first + field.n_components - 1,
                              field.name,
                              field.interpretation);
        first += field.n_components;
      }
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
  }


  void
  VtuOutput::write(const Discretization                &discretization,
                   const SectionLaw                    &section,
                   const KinematicsOptions             &kinematics,
                   const TrilinosWrappers::MPI::Vector &ghosted_displacement,
                   const std::string                   &folder,
                   const std::string                   &name,
                   const Entry                         &entry,
                   const std::vector<double>           &error_indicators)
  {
    const MPI_Comm communicator = discretization.communicator();
    run_on_root(communicator, [&] { create_folder(folder); });
    std::unique_ptr<ShellFields> fields;
    run_on_all_ranks(communicator, [&] {
      fields = std::make_unique<ShellFields>(discretization,
                                             section,
                                             kinematics,
                                             ghosted_displacement,
                                             error_indicators,
                                             options_.n_subdivisions);
    });
    const std::string base    = name + "_" + entry.label;
    const std::string all     = path_of(folder, name);
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
    run_on_root(communicator, [&] {
      if (is_hdf5)
        {
          write_file(all + ".xdmf",
                     [&](std::ostream &out) { write_xdmf(out, records); });
          return;
        }
      std::vector<std::pair<double, std::string>> times;
      for (const auto &record : records)
        times.push_back(record.second);
      write_file(all + ".pvd", [&](std::ostream &out) {
        DataOutBase::write_pvd_record(out, times);
      });
    });
  }
} // namespace Nacre
