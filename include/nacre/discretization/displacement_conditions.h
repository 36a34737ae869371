// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_discretization_displacement_conditions_h
#define nacre_discretization_displacement_conditions_h

#include <nacre/discretization/edge_nodes.h>
#include <nacre/discretization/point_constraints.h>

#include <map>
#include <set>
#include <string>
#include <vector>

namespace Nacre
{
  struct Foundation;
  class RigidMotions;
  class ShellComponents;

  /**
   * Prescribed displacements as constraints of nodes: every node collects the
   * components that its edges and point supports prescribe; components that
   * depend on each other must agree. Supports of points between the nodes are
   * PointConstraints.
   */
  class DisplacementConditions
  {
  public:
    /**
     * Collective. Throws, on all ranks, for contradicting conditions, for a
     * symmetry or diaphragm edge that isn't plane, and for a point support
     * that lies off the mesh or on both lips of a slit.
     * @param instant of the prescribed displacements
     * @param finest conditions on a finer mesh of the surface, from which the
     *   planes of symmetry are taken
     * @param foundation that holds rigid motions, too; null: none
     */
    DisplacementConditions(const Discretization         &discretization,
                           const BoundaryConditions     &boundary_conditions,
                           const Instant                &instant    = Instant(),
                           const DisplacementConditions *finest     = nullptr,
                           const Foundation             *foundation = nullptr);

    /** Hanging nodes and prescribed displacements on the relevant dofs. */
    const AffineConstraints<double> &
    constraints() const
    {
      return constraints_;
    }

    /** The dofs that constraints() mentions, and the locally relevant ones. */
    const IndexSet &
    relevant_dofs() const
    {
      return relevant_dofs_;
    }

    /** A node of which a displacement is prescribed. */
    struct HeldNode
    {
      Point<spacedim>                               position;
      std::array<types::global_dof_index, spacedim> dofs;
    };

    /** All such nodes of all ranks, each of them once. */
    std::vector<HeldNode>
    held_nodes() const;

    /** Boundary ids of all edges with conditions. */
    std::set<types::boundary_id>
    edges() const;

    /** Supports of points between the nodes. */
    const PointConstraints &
    points_between_nodes() const
    {
      return points_;
    }

    /**
     * The rigid motions that neither a displacement nor a rotation condition
     * nor the foundation prevents, in words; empty if the shell is held. Of a
     * shell of several components the words name a point. Collective.
     */
    std::vector<std::string>
    free_rigid_motions() const;

    /**
     * The part of a @p force at a point of the edge @p id along the directions
     * in which no displacement is prescribed there.
     * @param normal t0 @param conormal outward, both unit vectors
     */
    Tensor<1, spacedim>
    free_part(const types::boundary_id   id,
              const Tensor<1, spacedim> &normal,
              const Tensor<1, spacedim> &conormal,
              const Tensor<1, spacedim> &force) const;

  private:
    /** What the foundation holds of this rank's cells, by component. */
    void
    hold_by_foundation(const ShellComponents     &components,
                       std::vector<RigidMotions> &motions) const;

    using Vector3 = Tensor<1, spacedim>;

    /** One prescribed component direction . u = value of a node. */
    struct Component
    {
      Vector3            direction;
      double             value;
      const std::string *source;
    };

    struct Node
    {
      Point<spacedim>                               position;
      std::array<types::global_dof_index, spacedim> dofs;
      std::vector<Component>                        components;
    };

    /** Unit normal of the plane that holds an edge. */
    Vector3
    plane_normal(const std::vector<EdgeNode> &nodes,
                 const types::boundary_id     id,
                 const std::string           &source) const;

    /**
     * The unit vectors along which a condition prescribes the displacement.
     * @param plane unit normal of the plane that holds the edge
     */
    static std::vector<Vector3>
    directions_of(const Direction direction,
                  const EdgeNode &node,
                  const Vector3  &plane);

    void
    add_edge_conditions(const std::vector<EdgeNode> &nodes);

    /** Supports of nodes; returns those of points between the nodes. */
    std::vector<PointCondition>
    add_point_supports();

    /** Add @p conditions to the closed constraints of nodes. */
    void
    constrain_points(const std::vector<PointCondition> &conditions);

    /**
     * Make the components of a node orthonormal, one after the other, without
     * changing what they prescribe. Throws where they contradict each other.
     */
    static std::vector<Component>
    independent_components(const Node &node);

    /**
     * Solve the components for one space component each, with the largest
     * coefficients; returns which.
     */
    static std::vector<unsigned int>
    solve_for_pivots(std::vector<Component> &basis);

    /** Add the lines of one node. */
    void
    constrain(const Node &node);

    const Discretization     &discretization_;
    const BoundaryConditions &boundary_conditions_;
    const Instant             instant_;
    const Foundation *const   foundation_;
    /** Dofs whose constraints this rank knows. */
    IndexSet                  local_lines_;
    IndexSet                  relevant_dofs_;
    AffineConstraints<double> constraints_;
    PointConstraints          points_;

    /** By the node's first dof, the same on all ranks. */
    std::map<types::global_dof_index, Node> nodes_;
    /**
     * Unit normals of the planes that hold symmetry and diaphragm edges, by
     * EdgeConditions::edge.
     */
    std::map<types::boundary_id, Vector3> planes_;
    /** First dofs of nodes and axes t there where t . omega is prevented. */
    std::vector<std::pair<types::global_dof_index, Vector3>> rotation_axes_;
  };
} // namespace Nacre

#endif
