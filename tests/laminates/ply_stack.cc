// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

// The notation of stacks: what it means, and what is refused.

#include <nacre/mechanics/ply_stack.h>

#include <deal.II/base/exceptions.h>

#include <iostream>
#include <sstream>

using namespace Nacre;

int
main()
{
  for (const std::string text : {"[0/45/-45/90]s",
                                 "[0/90]2s",
                                 "[0/90]_{2s}",
                                 "[0/90]2",
                                 "[0/90]t",
                                 "[45_2/0]",
                                 "[+-45]s",
                                 "[-+30/0]",
                                 "[\u00b145/\u221315]",
                                 "[(0/90)_2/45]",
                                 "[(+-45)2]",
                                 "[ 22.5 / -7 ]",
                                 "[0]4",
                                 "[0_carbon/45_2glass]s",
                                 "[(0/90)_2foam/0_a-1]"})
    {
      std::cout << text << ':';
      for (const Ply &ply : parse_ply_stack(text, "Stack"))
        std::cout << ' ' << ply.angle
                  << (ply.material.empty() ? "" : "=" + ply.material);
      std::cout << std::endl;
    }
  for (const std::string text : {"",
                                 "0/90",
                                 "[0/90",
                                 "[0//90]",
                                 "[]",
                                 "[0/90]x",
                                 "[0/90]0s",
                                 "[0/90]s2",
                                 "[0/[90]2]",
                                 "[(0/90]",
                                 "[0/90)]",
                                 "[+-45_2]",
                                 "[++45]",
                                 "[0_]",
                                 "[0_0]",
                                 "[0,90]",
                                 "[(0_a/90)_b]",
                                 "[400]",
                                 "[1.2.3]",
                                 "[e5]",
                                 "[0]1001",
                                 "[(0_100)_20]",
                                 "[0]99999999999999999999"})
    {
      std::string message = "ACCEPTED " + text;
      try
        {
          parse_ply_stack(text, "Stack");
        }
      catch (const dealii::ExceptionBase &exception)
        {
          // In one line, up to the advice that all messages end with
          std::istringstream words(exception.what());
          message.clear();
          for (std::string word; words >> word;)
            message += (message.empty() ? "" : " ") + word;
          const auto begin = message.find("Stack: '");
          message =
            message.substr(begin, message.find(". Write the plies") - begin);
        }
      std::cout << message << std::endl;
    }
}
