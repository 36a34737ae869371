// SPDX-License-Identifier: LGPL-2.1-or-later
// What a target without tests compiles: CMakeLists.txt precompiles deal.II's
// headers for all tests with it.
