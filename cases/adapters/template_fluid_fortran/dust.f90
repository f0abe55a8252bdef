!> A complete fluid in Fortran, in place of coracle-fluid: dust, a medium without pressure and viscosity that the solid takes
!> along.  What a flow solver does more goes where u_star and u_projected are computed.
!>
!>       3---2 3       the mesh is that of fluid.mesh: rectangles cut into two triangles, dealt to the ranks by rows; velocity
!>       |  / /|       is linear on each triangle and discontinuous between them, u(vertex, component, element)
!>       | / / |
!>       |/ /  |
!>       1 1---2
module dust_fluid  ! region is called from C: it must not be internal to the program
  use coracle
  use mpi
  implicit none
  type(c_ptr) :: client
  integer :: comm, rank, ranks, action, error, nnear = 0
  real(c_double) :: lower(2), upper(2), density, viscosity, area, dt_max, t, dt, mass(3, 3)
  real(c_double), allocatable :: x(:, :, :)          ! m
  real(c_double), allocatable, target :: u(:, :, :)  ! m/s; what a step changes; the library restores it when it is redone
  integer, allocatable :: near(:), before(:)         ! the elements that the coupler knows, by its numbers + 1
  real(c_double), allocatable, target :: x_near(:, :, :), rho(:), mu(:), p(:, :), u_start(:, :, :), u_star(:, :, :)

contains

  subroutine make_mesh()
    type(c_ptr) :: file
    integer :: cells(2), first, last, i, j, k
    real(c_double) :: h(2), corner(2, 2)
    call coracle_case_open(client, file)
    call coracle_case_vector(file, "fluid.mesh.lower", lower)
    call coracle_case_vector(file, "fluid.mesh.upper", upper)
    density = coracle_case_positive(file, "fluid.density")
    viscosity = coracle_case_positive(file, "fluid.viscosity")
    dt_max = coracle_case_positive(file, "time.dt_max")
    cells = ceiling((upper - lower) / coracle_case_positive(file, "fluid.mesh.size_max") - 1e-9_c_double)
    error = CoracleCaseClose(file)
    h = (upper - lower) / cells
    area = h(1) * h(2) / 2
    mass = area / 12 * reshape([2, 1, 1, 1, 2, 1, 1, 1, 2], [3, 3])  ! int N_i N_j
    first = cells(2) * rank / ranks
    last = cells(2) * (rank + 1) / ranks - 1
    k = 2 * cells(1) * (last - first + 1)
    allocate(x(2, 3, k), u(3, 2, k), near(k), x_near(2, 3, k), rho(k), mu(k))
    u = 0
    rho = density
    mu = viscosity
    k = 1
    do j = first, last
      do i = 0, cells(1) - 1
        corner(:, 1) = lower + h * [i, j]
        corner(:, 2) = lower + h * [i + 1, j + 1]
        x(:, :, k) = reshape([corner(:, 1), corner(:, 2), corner(1, 1), corner(2, 2)], [2, 3])
        x(:, :, k + 1) = reshape([corner(:, 1), corner(1, 2), corner(2, 1), corner(:, 2)], [2, 3])
        k = k + 2
      end do
    end do
  end subroutine

  !> CoracleRegionFunction
  integer(c_int) function region(context, nbox, box, elements) bind(c)
    type(c_ptr), value :: context
    integer(c_int), value :: nbox
    real(c_double), intent(in) :: box(2, 2, nbox)
    type(CoracleElements), intent(inout) :: elements
    integer :: e, b
    nnear = 0
    do e = 1, size(x, 3)
      do b = 1, nbox
        if (any(minval(x(:, :, e), 2) > box(:, 2, b)) .or. any(maxval(x(:, :, e), 2) < box(:, 1, b))) cycle
        nnear = nnear + 1
        near(nnear) = e
        x_near(:, :, nnear) = x(:, :, e)
        exit
      end do
    end do
    elements = CoracleElements(nnear, c_loc(x_near), c_loc(rho), c_loc(mu))
    region = 0
  end function

  !> rho M/dt (u* - u) + inertia (tensor u* - kept u) + a u* = s on the coupled elements, 0 for u where they are covered; elsewhere nothing acts.
  subroutine advance()
    type(CoracleCoupling), pointer :: k(:)
    real(c_double) :: a(6, 6), inertia(6, 6), load(6)
    integer :: m, e, c, d
    call coracle_get_coupling(client, k)
    if (t == 0) call begin(k)
    u_start = u(:, :, near(:nnear))
    u_star = u_start
    do m = 1, size(k)
      e = k(m)%element + 1
      do c = 0, 1
        do d = 0, 1
          inertia(3*c + 1:3*c + 3, 3*d + 1:3*d + 3) = k(m)%inertia_tensor(d + 1, c + 1) * k(m)%implicit_inertia
        end do
        inertia(3*c + 1:3*c + 3, 3*c + 1:3*c + 3) = inertia(3*c + 1:3*c + 3, 3*c + 1:3*c + 3) + density / dt * mass
      end do
      a = inertia + transpose(reshape(k(m)%a, [6, 6]))
      load = reshape(k(m)%s + matmul(k(m)%implicit_inertia, matmul(u_star(:, :, e), k(m)%kept)), [6])
      if (iand(k(m)%flags, CORACLE_IS_COVERED) == 0) load = load + density / dt * reshape(matmul(mass, u_star(:, :, e)), [6])
      call solve(a, load)
      u_star(:, :, e) = reshape(load, [3, 2])
    end do
  end subroutine

  !> In a run's first step the dust inside the solid moves with it.
  subroutine begin(k)
    type(CoracleCoupling), intent(in) :: k(:)
    integer :: m, e, i
    do m = 1, size(k)
      e = near(k(m)%element + 1)
      do i = 1, 3
        u(i, :, e) = u(i, :, e) + k(m)%alpha * (k(m)%velocity - u(i, :, e))
      end do
    end do
  end subroutine

  subroutine set_flow()
    type(CoracleFlow) :: flow
    if (CoracleNeedsPressure(client) == 1) p = spread(0 * rho(:nnear), 1, CORACLE_PRESSURE_NODES)
    flow = CoracleFlow(c_loc(u_start), c_loc(u_star), c_loc(u_star), c_null_ptr, c_loc(rho), c_loc(mu))
    if (allocated(p)) flow%p = c_loc(p)
    error = CoracleSetFlow(client, flow)
  end subroutine

  !> u += M^-1 r inside the solid; the elements, before, are those that the step began with.
  subroutine correct()
    type(CoracleCorrection), pointer :: k(:)
    real(c_double) :: m(3, 3), du(3)
    integer :: i, c, e
    call coracle_get_correction(client, k)
    do i = 1, size(k)
      e = before(k(i)%element + 1)
      do c = 1, 2
        m = mass
        du = k(i)%r(:, c)
        call solve(m, du)
        u(:, c, e) = u(:, c, e) + du
      end do
    end do
  end subroutine

  !> x = A^-1 x by Gauss' elimination; a, of a positive definite system, is overwritten.
  subroutine solve(a, x)
    real(c_double), intent(inout) :: a(:, :), x(:)
    real(c_double) :: f
    integer :: k, i
    do k = 1, size(x)
      do i = 1, size(x)
        if (i == k) cycle
        f = a(i, k) / a(k, k)
        a(i, k:) = a(i, k:) - f * a(k, k:)
        x(i) = x(i) - f * x(k)
      end do
    end do
    x = x / [(a(k, k), k = 1, size(x))]
  end subroutine
end module

program dust
  use dust_fluid
  implicit none
  call coracle_open("fluid", comm, client)
  call MPI_Comm_rank(comm, rank, error)
  call MPI_Comm_size(comm, ranks, error)
  call make_mesh()
  error = CoracleSetRegion(client, CORACLE_DIM, lower, upper, c_funloc(region), c_null_ptr)
  if (size(u) > 0) error = CoracleBindState(client, c_loc(u), storage_size(u, c_size_t) / 8 * size(u))
  error = CoracleProposeStep(client, dt_max)
  error = CoracleReady(client)
  do
    error = CoracleBegin(client, t, dt, action)
    if (action == CORACLE_STOP) exit
    before = near(:nnear)
    call advance()
    ! a projection has the bulk velocity u* + M^-1 (us - ms u*) and W = rho M/dt + implicit_inertia inertia_tensor; here u projected is u*
    call set_flow()
    error = CoracleProposeStep(client, dt_max)
    error = CoracleEnd(client)
    if (CoracleStepAccepted(client) == 1) then
      u(:, :, before) = u_star
      call correct()
    end if
  end do
  error = CoracleClose(client)
end program
