// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_postprocess_hdf5_output_h
#define nacre_postprocess_hdf5_output_h

#include <nacre/postprocess/vtu_output.h>

#include <iosfwd>
#include <string>

namespace Nacre
{
  /**
   * Write @p fields of all ranks into one file `BASE.h5`: points, linear cells,
   * and a data set for each field; the rows of a tensor T are three vectors
   * T_x, T_y, T_z. A file that can't be written throws an ExcMessage with its
   * name. Collective.
   * @param cell quadrilateral or triangle
   * @return on all ranks the grid of XDMF that describes it, for write_xdmf()
   */
  std::string
  write_hdf5(const ShellFields   &fields,
             const MPI_Comm       communicator,
             const ReferenceCell &cell,
             const std::string   &folder,
             const std::string   &base,
             const double         time);

  /** An .xdmf: the grids of all times. */
  void
  write_xdmf(std::ostream &out, const FieldRecords &grids);
} // namespace Nacre

#endif
