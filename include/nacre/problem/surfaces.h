// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_problem_surfaces_h
#define nacre_problem_surfaces_h

#include <nacre/base/input_file.h>
#include <nacre/base/selection.h>
#include <nacre/problem/parametric_surface.h>

#include <array>
#include <map>
#include <string>
#include <vector>

namespace Nacre
{
  /**
   * What the parameter file says about the chosen surface, as numbers. Every
   * function throws an ExcMessage that names the parameter, what was found and
   * what is allowed.
   */
  class SurfaceInput
  {
  public:
    /** Begin and end. */
    using Range = std::array<double, 2>;

    /** The texts of the parameters that all surfaces share. */
    struct Mesh
    {
      std::string                subdivisions;
      std::array<std::string, 2> grading;
    };

    /** Texts of the parameters by surface and parameter. */
    using Values = std::map<std::string, std::map<std::string, std::string>>;

    /** How files are read: see read_input_file(). */
    struct Files
    {
      MPI_Comm    communicator = MPI_COMM_SELF;
      std::string folder;
    };

    /**
     * @param path the subsection of all surfaces, for messages
     * @param surface the surface's name and subsection
     * @param values the texts of all surfaces' parameters
     */
    SurfaceInput(const std::string &path,
                 const std::string &surface,
                 const Values      &values,
                 const Mesh        &mesh,
                 const Constants   &constants,
                 const Files       &files);

    /**
     * The input of another surface, with any coarse mesh: for those who ask
     * for its map alone.
     */
    SurfaceInput
    of_map(const std::string &surface) const;

    /** The file that a parameter names. Collective. */
    InputFile
    file(const std::string &parameter) const;

    /** A file that another one in @p folder names: read_input_file(). */
    InputFile
    file_beside(const std::string &name,
                const std::string &folder,
                const std::string &where) const;

    /** The full name of a parameter of this surface, or of its subsection. */
    std::string
    where(const std::string &parameter = "") const;

    const std::string &
    text(const std::string &parameter) const;

    const Constants &
    constants() const;

    /** Any number. */
    double
    number(const std::string &parameter) const;

    /** A number greater than zero. */
    double
    positive(const std::string &parameter) const;

    /** Two numbers greater than zero. */
    std::array<double, 2>
    positive_pair(const std::string &parameter) const;

    /** "begin, end" with begin < end. */
    Range
    range(const std::string &parameter) const;

    /** A range of angles in degrees, at most 360 long. */
    Range
    angle_range(const std::string &parameter) const;

    /** One of the @p allowed words. */
    std::string
    choice(const std::string              &parameter,
           const std::vector<std::string> &allowed) const;

    /** The same of the names of an enumeration that has a Selection. */
    template <typename E>
    E
    choice(const std::string &parameter) const
    {
      return *find_value<E>(choice(parameter, names_of<E>()));
    }

    /**
     * Coarse cells along u (0) or v (1); @p closed asks for three at least.
     */
    unsigned int
    n_cells(const unsigned int direction, const bool closed = false) const;

    /**
     * Chart coordinates of the coarse mesh lines across @p range,
     * range[0] + (range[1] - range[0]) g(i/n) with the grading g.
     */
    std::vector<double>
    mesh_lines(const unsigned int direction,
               const Range       &range,
               const bool         closed = false) const;

    /** For surfaces made of patches: cells along a patch; no grading. */
    unsigned int
    n_patch_cells() const;

  private:
    std::string path_;
    std::string surface_;
    Values      values_;
    Mesh        mesh_;
    Constants   constants_;
    Files       files_;
  };

  /** A parameter of a surface: all are texts that are evaluated later. */
  struct SurfaceParameter
  {
    std::string name;
    std::string default_value;
    std::string documentation;
  };

  /** A named surface: its parameters and its maker. */
  struct SurfaceKind
  {
    std::string                   name;
    std::vector<SurfaceParameter> parameters;
    SurfaceDescription (*make)(const SurfaceInput &input);
  };

  /** All surfaces: a new one is a function and a row of this table. */
  const std::vector<SurfaceKind> &
  surface_kinds();

  /**
   * A coarse mesh over the rectangle of the mesh lines @p u and @p v, with the
   * chart (u, v, 0), and the edges u=0, u=1, v=0, v=1 as far as they aren't
   * closed.
   */
  struct ChartRectangle
  {
    std::vector<double> u;
    std::vector<double> v;
    std::array<bool, 2> closed{{false, false}};
    /** Further names of u=0, u=1, v=0, v=1. */
    std::array<std::vector<std::string>, 4> aliases{};
    /** Whether the normal is -x,u x x,v. */
    bool flip = false;
  };

  SurfaceDescription
  make_rectangle(const ChartRectangle           &rectangle,
                 std::unique_ptr<const ChartMap> map);

  /** @name Surfaces made of several patches */
  //@{
  /**
   * Disk of radius R in the plane z = 0. The chart is a point (x, y) of the
   * square [-1, 1]^2; with m = max(|x|, |y|) the inner square m <= 1/2 is
   * mapped to 0.8 R (x, y), and beyond it, for |x| = m,
   *   (2 - 2m) 0.4 R (s, t) + (2m - 1) R (s cos(pi t/4), sin(pi t/4)),
   *   s = sign(x), t = y/m,
   * likewise with x and y exchanged for |y| = m.
   */
  SurfaceDescription
  make_disk(const SurfaceInput &input);

  std::vector<SurfaceParameter>
  disk_parameters();

  /**
   * Three squares of side a in the plane z = 0, an L with its re-entrant corner
   * at the origin; x = c.
   */
  SurfaceDescription
  make_l_shaped_plate(const SurfaceInput &input);

  std::vector<SurfaceParameter>
  l_shaped_plate_parameters();

  /**
   * Sphere of radius R about the origin. The chart is a point c of the surface
   * of the cube [-1, 1]^3, x = R d/|d| with d_i = tan(pi c_i/4).
   */
  SurfaceDescription
  make_sphere(const SurfaceInput &input);

  std::vector<SurfaceParameter>
  sphere_parameters();

  /**
   * Upper half of a sphere, z >= 0. With a hole around the pole (u: azimuth,
   * v: latitude, degrees)
   *   x = R (cos v cos u, cos v sin u, sin v);
   * without, the patches of make_sphere().
   */
  SurfaceDescription
  make_hemisphere(const SurfaceInput &input);

  std::vector<SurfaceParameter>
  hemisphere_parameters();
  //@}

  /** @name Surfaces of mesh files: doc/mesh_files.md */
  //@{
  /**
   * The cells of a file with the positions of their nodes as charts, and the
   * identity as map, or the projection onto a named surface.
   */
  SurfaceDescription
  make_file_surface(const SurfaceInput &input);

  std::vector<SurfaceParameter>
  file_surface_parameters();
  //@}
} // namespace Nacre

#endif
