// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_problem_cuts_h
#define nacre_problem_cuts_h

#include <nacre/base/selection.h>
#include <nacre/base/types.h>
#include <nacre/mechanics/section_law.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/parameter_acceptor.h>

#include <functional>
#include <string>
#include <vector>

namespace Nacre
{
  class Midsurface;

  /** A curve along which the shell is cut: straight between its points. */
  struct CutCurve
  {
    /** What the points' numbers are. */
    enum class Coordinates
    {
      /** (u, v, 0) of the surface's chart */
      chart,
      /** (x, y, z), on the surface or nearly so (length) */
      space
    };

    std::string name;
    Coordinates coordinates = Coordinates::chart;
    /** Two at least, three if closed; neighbours differ. */
    std::vector<Point<spacedim>> points;
    /** Whether the last point is joined to the first, which isn't repeated. */
    bool is_closed = false;
  };

  /** What the displacements have at the tips of cuts. */
  enum class CutTips
  {
    /** Nothing: the crack closes at the edge by which it enters the cell. */
    closed,
    /**
     * Functions that open the cut inside of the cell, harmonic ones for
     * tangential displacements, biharmonic ones for normal ones.
     */
    harmonic,
    /** Harmonic functions for all: Kaufmann et al. (2009). */
    harmonic_all_components,
    /** Williams' fields with coefficients of the tip's own. */
    branch_functions
  };

  const Selection<CutTips> &selection(CutTips);

  /** The cuts of a shell, and how they enter the mesh. */
  struct Cuts
  {
    std::vector<CutCurve> curves = {};
    /** A point (length) of each piece of the shell that is taken away. */
    std::vector<Point<spacedim>> remove = {};
    /** Nearer to a vertex than this part of an edge, a cut runs through it. */
    double snap = 0.02;
    /** Parts of cells below this part of the cell follow a neighbour. */
    double  smallest_part = 0.25;
    CutTips tips          = CutTips::closed;
    /**
     * Distance (length) from a tip up to which its branch functions are whole;
     * they are so in the cells that touch the tip's cell in any case.
     */
    double tip_radius = 0.;
    /**
     * Whether the tips' functions are to span themselves after any rotation,
     * for kinematics of finite rotations: TipFunctions of scalars.
     */
    bool tips_turn = false;
    /**
     * Poisson's ratio at a tip, on which tips' functions depend. It throws if
     * the section has none and they are branch functions. Axes e_1, e_2:
     * tangent, orthogonal, of length 1.
     */
    std::function<double(const SectionPoint &,
                         const Tensor<1, spacedim> &,
                         const Tensor<1, spacedim> &)>
      poissons_ratio = {};

    bool
    is_empty() const
    {
      return curves.empty();
    }
  };

  /** The number of the cut of a name; throws if there is none. */
  unsigned int
  find_cut(const std::string &name, const Cuts &cuts, const std::string &where);

  /** The section Cuts of a parameter file. */
  class CutParameters : public ParameterAcceptor
  {
  public:
    CutParameters();

    /**
     * How make() reads files: on rank 0 of @p communicator, a relative name
     * from the @p folder of the parameter file.
     */
    void
    set_files(const MPI_Comm communicator, const std::string &folder);

    /**
     * Throws an ExcMessage for what is no curve, for two cuts of one name, for
     * chart points of a surface that has no chart, and for points to be removed
     * where nothing is cut. Collective if a curve is a file's.
     */
    Cuts
    make(const Constants &constants, const Midsurface &midsurface) const;

  private:
    std::string cuts_text_;
    std::string remove_text_;
    double      snap_          = Cuts().snap;
    double      smallest_part_ = Cuts().smallest_part;
    CutTips     tips_          = Cuts().tips;
    std::string tip_radius_    = "0";

    MPI_Comm    communicator_ = MPI_COMM_SELF;
    std::string folder_;
  };
} // namespace Nacre

#endif
