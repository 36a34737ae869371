// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/text.h>
#include <nacre/mechanics/ply_stack.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>

namespace Nacre
{
  using namespace dealii;

  namespace
  {
    constexpr std::size_t max_plies = 1000;

    /** @p text with every @p from replaced. */
    std::string
    replaced(std::string text, const std::string &from, const std::string &to)
    {
      for (std::size_t i = text.find(from); i != std::string::npos;
           i             = text.find(from, i + to.size()))
        text.replace(i, from.size(), to);
      return text;
    }

    /** Reads a stack from left to right. */
    class StackReader
    {
    public:
      StackReader(const std::string &text, const std::string &where)
        : original_(Text::trim(text))
        , where_(where)
      {
        // The signs of Unicode, and the braces of subscripts
        text_ = replaced(original_, "\u00b1", "+-");
        text_ = replaced(text_, "\u2213", "-+");
        text_ = replaced(replaced(text_, "{", ""), "}", "");
        text_.erase(std::remove_if(text_.begin(),
                                   text_.end(),
                                   [](const unsigned char c) {
                                     return std::isspace(c) != 0;
                                   }),
                    text_.end());
      }

      std::vector<Ply>
      read()
      {
        check(take('['), "it must begin with '['");
        auto plies = read_group(']');
        check(take(']'), "it has no ']' at its end");
        take('_');
        plies             = repeated(plies, read_count());
        const char suffix = std::tolower(static_cast<unsigned char>(next()));
        if (suffix == 's' || suffix == 't')
          ++place_;
        if (suffix == 's')
          {
            const std::vector<Ply> mirrored(plies.rbegin(), plies.rend());
            plies.insert(plies.end(), mirrored.begin(), mirrored.end());
          }
        check(place_ == text_.size(),
              "'" + text_.substr(place_) +
                "' behind the brackets is not understood; a number, s "
                "(symmetric) and t (total) may stand there");
        check(plies.size() <= max_plies, "it has more than 1000 plies");
        return plies;
      }

    private:
      void
      check(const bool good, const std::string &what) const
      {
        AssertThrow(good,
                    ExcMessage(where_ + ": '" + original_ + "': " + what +
                               ". Write the plies from bottom to top as in "
                               "'[0/45/-45/90]s', '[0/90]2s', '[+-45/0_2]', "
                               "'[(0/90)_2/45]', '[0_carbon/0_2glass]'."));
      }

      char
      next() const
      {
        return place_ < text_.size() ? text_[place_] : '\0';
      }

      bool
      take(const char c)
      {
        if (next() != c)
          return false;
        ++place_;
        return true;
      }

      bool
      at_digit() const
      {
        return std::isdigit(static_cast<unsigned char>(next())) != 0;
      }

      /** A number of repetitions; 1 if none stands there. */
      unsigned int
      read_count()
      {
        if (!at_digit())
          return 1;
        std::size_t count = 0;
        while (at_digit())
          {
            count = 10 * count + (text_[place_++] - '0');
            check(count <= max_plies, "a number of plies is larger than 1000");
          }
        check(count > 0, "a number of plies is 0");
        return count;
      }

      std::vector<Ply>
      repeated(const std::vector<Ply> &plies, const unsigned int count) const
      {
        check(plies.size() * count <= max_plies, "it has more than 1000 plies");
        std::vector<Ply> result;
        for (unsigned int k = 0; k < count; ++k)
          result.insert(result.end(), plies.begin(), plies.end());
        return result;
      }

      /** Items with '/' between them, up to the character @p end. */
      std::vector<Ply>
      read_group(const char end)
      {
        std::vector<Ply> plies;
        do
          {
            const auto item = read_item();
            plies.insert(plies.end(), item.begin(), item.end());
            check(plies.size() <= max_plies, "it has more than 1000 plies");
        } while (take('/'));
        check(next() == end || next() == '\0',
              "'" + text_.substr(place_) +
                "' is not understood; '/' stands between plies");
        return plies;
      }

      /** A group in parentheses or an angle, and its subscript. */
      std::vector<Ply>
      read_item()
      {
        check(next() != '[',
              "brackets within brackets; groups are in parentheses");
        std::vector<Ply> plies;
        const bool       is_group = take('(');
        if (is_group)
          {
            plies = read_group(')');
            check(take(')'), "a ')' is missing");
          }
        else
          plies = read_angle();
        const bool   has_subscript = take('_');
        const bool   has_count     = at_digit();
        unsigned int count         = 1;
        if (has_subscript || is_group)
          count = read_count();
        std::string material;
        if (has_subscript)
          material = read_name();
        check(!has_subscript || has_count || !material.empty(),
              "'_' without a number of plies or the name of a material "
              "behind it");
        check(is_group || plies.size() == 1 || count == 1,
              "a number of plies behind a double sign has two meanings; "
              "write '(+-45)_2' or '45_2/-45_2'");
        if (!material.empty())
          for (Ply &ply : plies)
            {
              check(ply.material.empty(),
                    "a ply has two materials, '" + ply.material + "' and '" +
                      material + "'");
              ply.material = material;
            }
        return repeated(plies, count);
      }

      /** A letter and what belongs to its word. */
      std::string
      read_name()
      {
        std::string name;
        while (std::isalnum(static_cast<unsigned char>(next())) != 0 ||
               (next() == '-' && !name.empty()) ||
               (next() == '_' && !name.empty()))
          name += text_[place_++];
        return name;
      }

      /** An angle; two plies if it has both signs. */
      std::vector<Ply>
      read_angle()
      {
        double signs[2]  = {1., 1.};
        bool   is_double = false;
        if (next() == '+' || next() == '-')
          {
            signs[0] = text_[place_++] == '+' ? 1. : -1.;
            if (next() == '+' || next() == '-')
              {
                signs[1]  = text_[place_++] == '+' ? 1. : -1.;
                is_double = true;
                check(signs[0] != signs[1], "two equal signs of an angle");
              }
          }
        const std::size_t begin = place_;
        while (at_digit() || next() == '.')
          ++place_;
        const std::string number = text_.substr(begin, place_ - begin);
        char             *end    = nullptr;
        const double      angle  = std::strtod(number.c_str(), &end);
        check(!number.empty() && *end == '\0',
              "an angle in degrees is missing at '" + text_.substr(begin) +
                "'");
        check(std::abs(angle) <= 360.,
              "the angle " + number + " is larger than 360 degrees");
        std::vector<Ply> plies = {{signs[0] * angle}};
        if (is_double)
          plies.push_back({signs[1] * angle});
        return plies;
      }

      const std::string original_;
      const std::string where_;
      std::string       text_;
      std::size_t       place_ = 0;
    };
  } // namespace

  std::vector<Ply>
  parse_ply_stack(const std::string &text, const std::string &where)
  {
    return StackReader(text, where).read();
  }
} // namespace Nacre
