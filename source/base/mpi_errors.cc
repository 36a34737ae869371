// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/expression.h>
#include <nacre/base/mpi_errors.h>
#include <nacre/base/text.h>

#include <deal.II/base/exceptions.h>

#include <chrono>
#include <iostream>
#include <new>
#include <optional>
#include <sstream>
#include <thread>

namespace Nacre
{
  using namespace dealii;

  namespace
  {
    /** How long a rank that failed waits for the others to fail as well. */
    constexpr std::chrono::seconds patience(3);

    /** Whether all ranks come here within patience. */
    bool
    all_ranks_arrive(const MPI_Comm communicator)
    {
      MPI_Request request;
      MPI_Ibarrier(communicator, &request);
      const auto end     = std::chrono::steady_clock::now() + patience;
      int        arrived = 0;
      while (true)
        {
          MPI_Test(&request, &arrived, MPI_STATUS_IGNORE);
          if (arrived != 0 || std::chrono::steady_clock::now() > end)
            return arrived != 0;
          std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
    }

    void
    print_error(const std::string &text)
    {
      std::cout << std::flush;
      std::cerr << "nacre: error: " + text + '\n' << std::flush;
    }

    /** Of the texts of all ranks, the first that isn't empty; collective. */
    std::string
    first_error(const MPI_Comm communicator, const std::string &text)
    {
      for (const auto &other : Utilities::MPI::all_gather(communicator, text))
        if (!other.empty())
          return other;
      return "";
    }
  } // namespace


  std::string
  error_text(const std::exception &exception)
  {
    if (const auto *message =
          dynamic_cast<const StandardExceptions::ExcMessage *>(&exception))
      {
        std::ostringstream out;
        message->print_info(out);
        return Text::trim(out.str());
      }
    if (dynamic_cast<const std::bad_alloc *>(&exception) != nullptr)
      return "out of memory. Use fewer refinements, a lower degree, or a "
             "machine with more memory.";
#ifndef DEBUG
    // Leave out deal.II's frame and the stack.
    if (const auto *internal = dynamic_cast<const ExceptionBase *>(&exception))
      {
        std::ostringstream out;
        internal->print_info(out);
        const std::string info = Text::trim(out.str());
        return "the computation failed inside of the program; are all values "
               "of a reasonable size?" +
               (info == "(none)" ? "" : " " + info);
      }
#endif
    return Text::trim(exception.what());
  }


  int
  run_guarded(const MPI_Comm communicator, const std::function<int()> &run)
  {
    // Its own communicator: the barrier of a rank that failed must not meet
    // a collective operation of a rank that runs on.
    MPI_Comm errors;
    MPI_Comm_dup(communicator, &errors);

    int                        code = 1;
    std::optional<std::string> error;
    try
      {
        code = run();
      }
    catch (const std::exception &exception)
      {
        error = error_text(exception);
      }
    catch (...)
      {
        error = "an exception of unknown type.";
      }

    if (error)
      {
        if (!all_ranks_arrive(errors))
          {
            print_error(*error);
            MPI_Abort(communicator, 1);
          }
        // The messages of the ranks differ only in the place of the error.
        const std::string text = first_error(errors, *error);
        if (Utilities::MPI::this_mpi_process(communicator) == 0)
          print_error(text);
        code = 1;
      }
    MPI_Comm_free(&errors);
    return code;
  }


  void
  run_on_root(const MPI_Comm               communicator,
              const std::function<void()> &function)
  {
    std::string error;
    if (Utilities::MPI::this_mpi_process(communicator) == 0)
      try
        {
          function();
        }
      catch (const std::exception &exception)
        {
          error = error_text(exception);
        }
    error = Utilities::MPI::broadcast(communicator, error);
    AssertThrow(error.empty(), ExcMessage(error));
  }


  void
  run_on_all_ranks(const MPI_Comm               communicator,
                   const std::function<void()> &function)
  {
    std::string error;
    bool        is_undefined = false;
    try
      {
        function();
      }
    catch (const std::exception &exception)
      {
        error = error_text(exception);
        is_undefined =
          dynamic_cast<const ExcUndefinedValue *>(&exception) != nullptr;
      }
    for (const auto &[text, undefined] :
         Utilities::MPI::all_gather(communicator,
                                    std::make_pair(error, is_undefined)))
      {
        AssertThrow(text.empty() || !undefined, ExcUndefinedValue(text));
        AssertThrow(text.empty(), ExcMessage(text));
      }
  }
} // namespace Nacre
