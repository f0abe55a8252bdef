!> A complete solid in Fortran: a rigid disc that falls, drifts and rolls, in place of coracle-solid in any case whose
!> first body is a disc.
!>
!>       2 ___ 1      nodes 1 .. n on the circle, node n + 1 in the centre; connectivity counts from 0, as in C;
!>        /\ /\       facets i -> i + 1 run counter-clockwise, so that the disc lies on their left;
!>     3 |--n--| 0    triangles (n, i, i + 1) are the slices of the pie;
!>        \/_\/       rank 0 holds it all, other ranks are empty.
program rigid_disc
  use coracle
  use mpi
  implicit none
  real(c_double), parameter :: PI = acos(-1.0_c_double)
  type(c_ptr) :: client
  integer :: n = 0, nodes = 0, comm, rank, action, error
  real(c_double) :: radius, mass, inertia, gravity(2), t, dt
  !> what a step changes; the library restores it when a step is redone: x, y, angle; their velocities
  real(c_double), target :: state(6) = 0
  real(c_double), allocatable, target :: own(:, :)  ! m/s2, accelerations by all but the fluid
  real(c_double), allocatable :: before(:, :), after(:, :), u(:, :), w(:, :), mobility(:)
  real(c_double), pointer :: force(:, :)

  call coracle_open("solid", comm, client)
  call MPI_Comm_rank(comm, rank, error)
  call read_case()
  allocate(before(2, nodes), after(2, nodes), u(2, nodes), w(2, nodes), own(2, nodes), mobility(nodes))
  own = spread(gravity, 2, nodes)
  mobility = 1.5 * n / mass  ! one over a node's mass, a third of its slices
  if (nodes > 0) mobility(nodes) = 3 / mass
  error = CoracleBindState(client, c_loc(state), storage_size(state, c_size_t) / 8 * size(state))
  if (nodes > 0) error = CoracleBindState(client, c_loc(own), storage_size(own, c_size_t) / 8 * size(own))
  call give_mesh()
  error = CoracleSetInertia(client, mobility, own)
  error = CoracleReady(client)
  do
    error = CoracleBegin(client, t, dt, action)
    if (action == CORACLE_STOP) exit
    call coracle_get_force(client, nodes, force)
    before = positions()
    u = velocities(before)
    call advance()
    after = positions()
    w = velocities(after)
    ! the rest of the body moves a node beside the fluid: its acceleration less the fluid's force over its mass
    own = (w - u) / dt - spread(mobility, 1, 2) * force
    u = (after - before) / dt
    error = CoracleSubstep(client, dt, u)
    error = CoracleSetVelocity(client, w)
    error = CoracleSetInertia(client, mobility, own)
    error = CoracleEnd(client, after)
  end do
  if (rank == 0) call coracle_report(client, "centre_y", state(2), .false.)
  if (rank == 0) call coracle_report(client, "velocity_y", state(5), .false.)
  error = CoracleClose(client)

contains

  !> Per metre of depth; mass and inertia are the polygon's, which is what displaces fluid.
  subroutine read_case()
    type(c_ptr) :: file
    call coracle_case_open(client, file)
    call coracle_case_vector(file, "gravity", gravity)
    call coracle_case_vector(file, "solid.bodies[0].centre", state(1:2))
    if (coracle_case_has(file, "solid.bodies[0].velocity")) call coracle_case_vector(file, "solid.bodies[0].velocity", state(4:5))
    radius = coracle_case_positive(file, "solid.bodies[0].radius")
    n = ceiling(2 * PI * radius / coracle_case_positive(file, "solid.bodies[0].size"))
    mass = coracle_case_positive(file, "solid.materials."//coracle_case_string(file, "solid.bodies[0].material")//".density")
    mass = mass * 0.5 * n * radius**2 * sin(2 * PI / n)
    inertia = mass * radius**2 * (2 + cos(2 * PI / n)) / 6
    if (rank == 0) nodes = n + 1
    error = CoracleCaseClose(file)
  end subroutine

  function positions() result(x)
    real(c_double) :: x(2, nodes)
    integer :: i
    if (nodes == 0) return
    do i = 1, n
      x(:, i) = state(1:2) + radius * [cos(state(3) + 2 * PI * (i - 1) / n), sin(state(3) + 2 * PI * (i - 1) / n)]
    end do
    x(:, nodes) = state(1:2)
  end function

  function velocities(x) result(v)
    real(c_double), intent(in) :: x(2, nodes)
    real(c_double) :: v(2, nodes)
    v(1, :) = state(4) - state(6) * (x(2, :) - state(2))
    v(2, :) = state(5) + state(6) * (x(1, :) - state(1))
  end function

  subroutine give_mesh()
    integer(c_long_long) :: gid(nodes)
    integer(c_int) :: facet(2, nodes), slice(3, nodes)
    integer :: i, ne
    ne = max(nodes - 1, 0)
    gid = [(int(i, c_long_long), i = 0, nodes - 1)]
    do i = 1, ne
      facet(:, i) = [i - 1, mod(i, n)]
      slice(:, i) = [n, i - 1, mod(i, n)]
    end do
    before = positions()
    u = velocities(before)
    error = CoracleSetNodes(client, CORACLE_DIM, nodes, gid, before, u)
    error = CoracleSetSurface(client, ne, facet)
    error = CoracleSetVolume(client, ne, slice)
  end subroutine

  !> Newton and Euler over one step: m dv/dt = F + m g, I dw/dt = M.
  subroutine advance()
    real(c_double) :: moment
    moment = sum((before(1, :) - state(1)) * force(2, :) - (before(2, :) - state(2)) * force(1, :))
    state(4:5) = state(4:5) + dt * (sum(force, 2) / mass + gravity)
    state(6) = state(6) + dt * moment / inertia
    state(1:3) = state(1:3) + dt * state(4:6)
  end subroutine
end program
