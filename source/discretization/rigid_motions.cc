// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/discretization/rigid_motions.h>

#include <deal.II/base/mpi.h>

#include <deal.II/lac/lapack_full_matrix.h>

#include <sstream>

namespace Nacre
{
  namespace
  {
    std::string
    in_words(const Tensor<1, spacedim> &v)
    {
      std::ostringstream text;
      text.precision(4);
      text << '(';
      for (unsigned int c = 0; c < spacedim; ++c)
        text << (c > 0 ? ", " : "") << (std::abs(v[c]) < 1e-10 ? 0. : v[c]);
      text << ')';
      return text.str();
    }
  } // namespace

  RigidMotions::RigidMotions(const Point<spacedim> &centre, const double length)
    : centre_(centre)
    , length_(length)
    , held_(2 * spacedim, 2 * spacedim)
  {}

  void
  RigidMotions::hold_displacement(const Point<spacedim> &point,
                                  const Vector3         &direction)
  {
    hold(
      {{direction, cross_product_3d((point - centre_) / length_, direction)}});
  }

  void
  RigidMotions::hold_rotation(const Vector3 &axis)
  {
    hold({{Vector3(), axis}});
  }

  void
  RigidMotions::add_of_all_ranks(const RigidMotions &motions,
                                 const MPI_Comm      communicator)
  {
    FullMatrix<double> sum(motions.held_);
    Utilities::MPI::sum(motions.held_, communicator, sum);
    // Many points hold together: as much as one of them, or more.
    held_.add(1. / std::max(1., sum.trace() / (2 * spacedim)), sum);
  }

  void
  RigidMotions::hold(const Motion &motion)
  {
    for (unsigned int i = 0; i < 2 * spacedim; ++i)
      for (unsigned int j = 0; j < 2 * spacedim; ++j)
        held_(i, j) += motion[i / spacedim][i % spacedim] *
                       motion[j / spacedim][j % spacedim];
  }

  std::vector<RigidMotions::Motion>
  RigidMotions::null_space() const
  {
    LAPACKFullMatrix<double> lapack(held_.m());
    Vector<double>           values;
    FullMatrix<double>       vectors;
    const double             bound = 1. + 2. * held_.frobenius_norm();
    lapack                         = held_;
    lapack.compute_eigenvalues_symmetric(-bound, bound, 0., values, vectors);

    std::vector<Motion> motions;
    for (unsigned int k = 0; k < values.size(); ++k)
      if (values[k] <= 1e-8 * std::max(1., values[values.size() - 1]))
        {
          motions.emplace_back();
          for (unsigned int i = 0; i < 2 * spacedim; ++i)
            motions.back()[i / spacedim][i % spacedim] = vectors(i, k);
        }
    return motions;
  }

  void
  RigidMotions::reduce(std::vector<Motion> &motions)
  {
    // Eliminate rotations first, by the largest components.
    unsigned int n_done = 0;
    for (const unsigned int part : {1, 0})
      for (unsigned int c = 0; c < spacedim && n_done < motions.size(); ++c)
        {
          unsigned int best = n_done;
          for (unsigned int k = n_done; k < motions.size(); ++k)
            if (std::abs(motions[k][part][c]) >
                std::abs(motions[best][part][c]))
              best = k;
          const double pivot = motions[best][part][c];
          if (std::abs(pivot) < 1e-5)
            continue;
          std::swap(motions[n_done], motions[best]);
          for (auto &v : motions[n_done])
            v /= pivot;
          for (unsigned int k = 0; k < motions.size(); ++k)
            if (k != n_done)
              {
                const double factor = motions[k][part][c];
                for (unsigned int v = 0; v < 2; ++v)
                  motions[k][v] -= factor * motions[n_done][v];
              }
          ++n_done;
        }
  }

  std::vector<std::string>
  RigidMotions::free_motions() const
  {
    auto motions = null_space();
    reduce(motions);
    std::vector<std::string> names;
    for (const auto &[translation, rotation] : motions)
      if (rotation.norm() < 1e-5 * translation.norm())
        names.push_back("translation along " +
                        in_words(translation / translation.norm()));
      else
        {
          // The axis' point nearest to the centre: (omega x tau) / omega^2.
          const Vector3 point =
            Vector3(centre_) + length_ *
                                 cross_product_3d(rotation, translation) /
                                 rotation.norm_square();
          names.push_back("rotation about " +
                          in_words(rotation / rotation.norm()) + " through " +
                          in_words(point));
        }
    return names;
  }
} // namespace Nacre
