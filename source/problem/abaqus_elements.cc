// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/text.h>
#include <nacre/problem/abaqus_deck.h>

#include <array>

namespace Nacre::Abaqus
{
  namespace
  {
    struct Family
    {
      /** What the names of its types begin with. */
      std::string begin;
      std::string plural;
    };

    /** Elements with two or three nodes. */
    const std::vector<Family> &
    line_families()
    {
      static const std::vector<Family> families = {
        {"T2D", "trusses"},
        {"T3D", "trusses"},
        {"B2", "beams"},
        {"B3", "beams"},
        {"PIPE", "pipes"},
        {"ELBOW", "pipes"},
        {"FRAME", "frames"},
        {"SAX", "axisymmetric lines"},
        {"DSAX", "axisymmetric lines"},
        {"DC1D", "heat links"},
        {"MAX", "axisymmetric lines"},
        {"R2D", "rigid lines"},
        {"RAX", "rigid lines"},
        {"RB", "rigid beams"}};
      return families;
    }

    /** Elements that are no part of a surface nor of its boundary. */
    const std::vector<Family> &
    families_left_out()
    {
      static const std::vector<Family> families = {
        {"SPRING", "springs"},
        {"DASHPOT", "dashpots"},
        {"MASS", "masses"},
        {"ROTARYI", "masses"},
        {"HEATCAP", "masses"},
        {"CONN", "connectors"},
        {"JOINT", "connectors"},
        {"DCOUP", "couplings"},
        {"GAP", "gaps"},
        {"DGAP", "gaps"},
        {"ITS", "gaps"},
        {"ITT", "gaps"},
        {"IRS", "gaps"},
        {"ISL", "gaps"},
        {"PSI", "gaps"},
        {"DRAG", "drag chains"},
        {"F2D", "fluid elements"},
        {"F3D", "fluid elements"},
        {"FAX", "fluid elements"},
        {"FC3D", "fluid elements"},
        {"FC2D", "fluid elements"},
        {"FLINK", "fluid elements"},
        {"FP", "fluid elements"},
        {"AC1D", "acoustic elements"},
        {"AC2D", "acoustic elements"},
        {"AC3D", "acoustic elements"},
        {"ACAX", "acoustic elements"},
        {"ACIN", "acoustic elements"},
        {"ASI", "acoustic elements"},
        {"COH", "cohesive elements"},
        {"LS", "line springs"}};
      return families;
    }

    /** Shells, membranes and plane elements, then a number of nodes. */
    ElementKind
    surface_kind(const std::string &type)
    {
      using Shape = ElementShape;
      for (const char *const solid : {"C3D", "DC3D", "CC3D", "SC"})
        if (Text::begins_with(type, solid))
          return {Shape::solid, 0, type};
      if (type == "STRI65")
        return {Shape::triangle, 6, type};
      static const std::array<std::string, 14> families = {{"STRI",
                                                            "SFM3D",
                                                            "M3D",
                                                            "CPS",
                                                            "CPEG",
                                                            "CPE",
                                                            "CAX",
                                                            "CGAX",
                                                            "DCAX",
                                                            "DC2D",
                                                            "R3D",
                                                            "DS",
                                                            "US",
                                                            "S"}};
      for (const std::string &family : families)
        if (Text::begins_with(type, family) && type.size() > family.size())
          switch (type[family.size()])
            {
              case '3':
                return {Shape::triangle, 3, type};
              case '4':
                return {Shape::quadrilateral, 4, type};
              case '6':
                return {Shape::triangle, 6, type};
              case '8':
                return {Shape::quadrilateral, 8, type};
              case '9':
                return {Shape::quadrilateral, 9, type};
              default:
                break;
            }
      return {Shape::other, 0, type};
    }
  } // namespace


  DeckElement
  element_type(const std::string &name)
  {
    for (const Family &family : line_families())
      if (Text::begins_with(name, family.begin))
        {
          // Cubic beams, B23 and B33, have two nodes.
          bool has_middle = name == "T2D3" || name == "T3D3";
          for (const char *const begin :
               {"B22", "B32", "PIPE22", "PIPE32", "ELBOW32", "SAX2", "MAX2"})
            has_middle = has_middle || Text::begins_with(name, begin);
          return {ElementUse::line,
                  {ElementShape::line, has_middle ? 3u : 2u, name},
                  family.plural,
                  false};
        }
    if (name == "D")
      return {ElementUse::left_out,
              {ElementShape::other, 0, name},
              "network elements",
              false};
    for (const Family &family : families_left_out())
      if (Text::begins_with(name, family.begin))
        return {ElementUse::left_out,
                {ElementShape::other, 0, name},
                family.plural,
                false};
    DeckElement type;
    type.kind = surface_kind(name);
    for (const char *const plane : {"CPS", "CPE", "CAX", "CGAX", "DC"})
      type.is_plane = type.is_plane || Text::begins_with(name, plane);
    for (const auto &[begin, plural] :
         {Family{"R3D", "rigid elements"},
          Family{"SFM3D", "surface elements without stiffness"}})
      if (Text::begins_with(name, begin))
        {
          type.use    = ElementUse::spare_cell;
          type.plural = plural;
        }
    return type;
  }
} // namespace Nacre::Abaqus
