// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_mechanics_section_parameters_h
#define nacre_mechanics_section_parameters_h

#include <nacre/base/mesh_region.h>
#include <nacre/mechanics/section_law.h>

#include <deal.II/base/parameter_acceptor.h>

#include <memory>
#include <optional>

namespace Nacre
{
  /**
   * What a section reads of a parameter file. Both functions throw ExcMessage
   * for values out of range. The @p thickness (length) is that of a study over
   * thicknesses, in place of the file's, except in regions of the mesh that
   * have a thickness of their own.
   */
  class SectionParameters : public ParameterAcceptor
  {
  public:
    using ParameterAcceptor::ParameterAcceptor;

    /**
     * The constants E, nu, h of the section as far as they are numbers, for
     * the expressions of the mid-surface, of loads and reference values.
     */
    virtual Constants
    named_constants(const Constants             &constants,
                    const std::optional<double> &thickness) const = 0;

    /**
     * The law on a surface with the @p regions. Throws if there are values for
     * a region that isn't there, or for two names of one region.
     */
    virtual std::shared_ptr<const SectionLaw>
    make(const Constants             &constants,
         const std::optional<double> &thickness,
         const MeshRegions           &regions) const = 0;
  };
} // namespace Nacre

#endif
