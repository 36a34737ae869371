// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/mechanics/shell_section.h>

namespace Nacre
{
  ShellSection::ShellSection()
    : ParameterAcceptor("/Section")
  {
    add_parameter("Type",
                  type_,
                  "isotropic: a homogeneous section of the values below; "
                  "laminate: a stack of orthotropic plies, by the subsection "
                  "Laminate alone.",
                  prm,
                  Patterns::Selection("isotropic|laminate"));
  }

  void
  ShellSection::prepare(const Constants &constants)
  {
    AssertThrow(type_ != "laminate" || !isotropic_.has_regions(),
                ExcMessage("Section/Regions: these are regions of isotropic "
                           "sections; for 'Type = laminate' use "
                           "'Section/Laminate/Regions'."));
    choose();
    chosen_->prepare(constants);
  }

  void
  ShellSection::choose()
  {
    if (type_ == "laminate")
      chosen_ = &laminate_;
    else
      chosen_ = &isotropic_;
  }
} // namespace Nacre
