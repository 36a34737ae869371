// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/mpi_errors.h>
#include <nacre/base/output_file.h>
#include <nacre/postprocess/hdf5_output.h>

#include <deal.II/base/mpi.h>

#include <filesystem>
#include <ostream>

namespace Nacre
{
  namespace
  {
    using Patch = ShellFields::Patch;

    /** XDMF as deal.II writes it knows no tensors: a vector for each row. */
    std::vector<ShellFields::NonscalarRange>
    vectors_only(const std::vector<ShellFields::NonscalarRange> &ranges)
    {
      std::vector<ShellFields::NonscalarRange> result;
      for (const auto &range : ranges)
        {
          const auto &[first, last, name, interpretation] = range;
          if (last - first + 1 == spacedim)
            result.push_back(range);
          else
            for (unsigned int row = 0; row < spacedim; ++row)
              result.emplace_back(
                first + spacedim * row,
                first + spacedim * row + spacedim - 1,
                name + "_" + "xyz"[row],
                DataComponentInterpretation::component_is_part_of_vector);
        }
      return result;
    }

    /** A 6-node triangle as four linear ones. */
    void
    split_triangle(const Patch &patch, std::vector<Patch> &result)
    {
      static const unsigned int parts[4][3] = {{0, 3, 5},
                                               {3, 1, 4},
                                               {5, 4, 2},
                                               {3, 4, 5}};
      const unsigned int        n_rows      = patch.data.n_rows();
      for (const auto &corners : parts)
        {
          Patch part;
          part.patch_index          = result.size();
          part.reference_cell       = patch.reference_cell;
          part.n_subdivisions       = 1;
          part.points_are_available = true;
          part.data.reinit(n_rows, 3);
          for (unsigned int k = 0; k < 3; ++k)
            {
              for (unsigned int row = 0; row < n_rows; ++row)
                part.data(row, k) = patch.data(row, corners[k]);
              for (unsigned int c = 0; c < spacedim; ++c)
                part.vertices[k][c] =
                  patch.data(n_rows - spacedim + c, corners[k]);
            }
          result.push_back(part);
        }
    }

    /** ShellFields as linear cells and vectors. */
    class LinearFields : public DataOutInterface<dim, spacedim>
    {
    public:
      explicit LinearFields(const ShellFields &fields)
        : fields_(fields)
      {
        for (const auto &patch : fields.get_patches())
          if (patch.reference_cell == ReferenceCells::Triangle)
            split_triangle(patch, triangles_);
      }

      const std::vector<Patch> &
      get_patches() const override
      {
        return triangles_.empty() ? fields_.get_patches() : triangles_;
      }

      std::vector<std::string>
      get_dataset_names() const override
      {
        return fields_.get_dataset_names();
      }

      std::vector<ShellFields::NonscalarRange>
      get_nonscalar_data_ranges() const override
      {
        return vectors_only(fields_.get_nonscalar_data_ranges());
      }

    private:
      const ShellFields &fields_;
      std::vector<Patch> triangles_;
    };

    /**
     * Write on all ranks of @p writers, which have cells; returns the grid on
     * the first of them.
     */
    std::string
    write_on_all(const LinearFields          &fields,
                 const MPI_Comm               writers,
                 const ReferenceCell         &cell,
                 const std::filesystem::path &path,
                 const std::string           &part,
                 const double                 time)
    {
      // Points are kept for each cell: stresses jump between cells.
      DataOutBase::DataOutFilter filter(
        DataOutBase::DataOutFilterFlags(false, true));
      fields.write_filtered_data(filter);
      try
        {
          fields.write_hdf5_parallel(filter, part, writers);
        }
      catch (const ExceptionBase &)
        {
          std::error_code not_there;
          std::filesystem::remove(part, not_there);
          AssertThrow(false,
                      ExcMessage("'" + path.string() +
                                 "' can't be written: is the disk full?"));
        }
      return fields
        .create_xdmf_entry(filter, path.filename().string(), time, writers)
        .get_xdmf_content(3, cell);
    }
  } // namespace


  std::string
  write_hdf5(const ShellFields   &shell_fields,
             const MPI_Comm       communicator,
             const ReferenceCell &cell,
             const std::string   &folder,
             const std::string   &base,
             const double         time)
  {
    const std::string file  = base + ".h5";
    const auto        path  = std::filesystem::path(folder) / file;
    const std::string part  = path.string() + ".part";
    std::size_t       bytes = 0;
    for (const auto &patch : shell_fields.get_patches())
      bytes += patch.data.n_elements() * sizeof(double);
    bytes = Utilities::MPI::sum(bytes, communicator);
    run_on_root(communicator, [&]() { check_space(path.string(), bytes); });
    // deal.II's writer fails on ranks without cells.
    const unsigned int rank = Utilities::MPI::this_mpi_process(communicator);
    const bool         has_cells = !shell_fields.get_patches().empty();
    const unsigned int first =
      Utilities::MPI::min(has_cells ?
                            rank :
                            Utilities::MPI::n_mpi_processes(communicator),
                          communicator);
    MPI_Comm writers = MPI_COMM_NULL;
    AssertThrowMPI(MPI_Comm_split(communicator,
                                  has_cells ? 1 : MPI_UNDEFINED,
                                  rank,
                                  &writers));
    std::string grid;
    if (has_cells)
      {
        grid = write_on_all(LinearFields(shell_fields),
                            writers,
                            cell,
                            path.string(),
                            part,
                            time);
        MPI_Comm_free(&writers);
      }
    AssertThrowMPI(MPI_Barrier(communicator));
    run_on_root(communicator, [&]() {
      std::error_code error;
      std::filesystem::rename(part, path, error);
      AssertThrow(!error,
                  ExcMessage("'" + path.string() +
                             "' can't be written: " + error.message() + "."));
    });
    return Utilities::MPI::broadcast(communicator, grid, first);
  }


  void
  write_xdmf(std::ostream &out, const FieldRecords &grids)
  {
    out << "<?xml version=\"1.0\" ?>\n"
           "<!DOCTYPE Xdmf SYSTEM \"Xdmf.dtd\" []>\n"
           "<Xdmf Version=\"2.0\">\n"
           "  <Domain>\n"
           "    <Grid Name=\"CellTime\" GridType=\"Collection\" "
           "CollectionType=\"Temporal\">\n";
    for (const auto &entry : grids)
      out << entry.second.second;
    out << "    </Grid>\n"
           "  </Domain>\n"
           "</Xdmf>\n";
  }
} // namespace Nacre
