!> Coracle's client library for Fortran: how a solid or a fluid written in Fortran joins a coupled run.
!>
!> Compile this file with your program (module files differ between compilers):
!>
!>     mpifort coracle.f90 my_solid.f90 $(pkg-config --libs coracle-client)
!>
!> Names, order of calls, units and errors are those of coracle.h.  C's [n][dim] is x(dim, n) here; indices in
!> connectivity and in `element` count from 0 as in C.  Arrays are handed over without a copy when contiguous.
module coracle
  use, intrinsic :: iso_c_binding
  implicit none
  private :: arguments

  integer, parameter :: CORACLE_DIM = 2, CORACLE_VERTICES = 3, CORACLE_PRESSURE_NODES = 6
  enum, bind(c)
    enumerator :: CORACLE_RUN, CORACLE_REDO, CORACLE_STOP
  end enum
  integer(c_int), parameter :: CORACLE_HAS_SHELL = 1, CORACLE_HAS_INERTIA = 2, CORACLE_IS_COVERED = 4, CORACLE_IS_HELD = 8
  integer(c_int), parameter :: CORACLE_HAS_CORNER = 16

  type, bind(c) :: CoracleElements
    integer(c_int) :: n
    type(c_ptr) :: x, rho, mu      ! (dim, vertices, n) m; (n) kg/m3; (n) Pa s
    type(c_ptr) :: rho_inside = c_null_ptr, rho_beside = c_null_ptr  ! (n) kg/m3; null: rho
  end type
  type, bind(c) :: CoracleCoupling
    integer(c_int) :: element, flags
    real(c_double) :: a(3, 2, 3, 2), implicit_inertia(3, 3)       ! kg/s; (j, d, i, c), (j, i)
    real(c_double) :: inertia_tensor(2, 2)                        ! 1; symmetric
    real(c_double) :: kept(2, 2)                                  ! 1; (d, c)
    real(c_double) :: s(3, 2)                                     ! N; (i, c)
    real(c_double) :: ms(3, 3), us(3, 2)                          ! m2; m3/s
    real(c_double) :: velocity(2), alpha, shell                   ! m/s; 1; 1
  end type
  type, bind(c) :: CoracleCorrection
    integer(c_int) :: element
    real(c_double) :: r(3, 2)      ! m3/s
  end type
  type, bind(c) :: CoracleGauge
    real(c_double) :: x(2), normal(2)  ! m; 1
  end type
  type, bind(c) :: CoracleFlow
    type(c_ptr) :: u_start, u_star, u_projected, p, rho, mu  ! (vertices, dim, n) m/s, thrice; (6, n) Pa; (n); (n)
    type(c_ptr) :: rho_inside = c_null_ptr, rho_beside = c_null_ptr  ! as in CoracleElements
    type(c_ptr) :: remainder = c_null_ptr  ! (dim, n) N; null: 0
  end type

  ! private to coracle_open and the like, with C's strings and arguments
  interface
    integer(c_int) function c_open(job, role, argc, argv, comm, client) bind(c, name="CoracleOpenFortran")
      import; type(c_ptr), value :: job; character(c_char), intent(in) :: role(*)
      integer(c_int), value :: argc; type(c_ptr), intent(in) :: argv(*)
      integer(c_int), intent(out) :: comm; type(c_ptr), intent(out) :: client
    end function
    subroutine c_fail(client, message) bind(c, name="CoracleFailMessage")
      import; type(c_ptr), value :: client; character(c_char), intent(in) :: message(*)
    end subroutine
    integer(c_int) function c_reject_step(client, why) bind(c, name="CoracleRejectStep")
      import; type(c_ptr), value :: client; character(c_char), intent(in) :: why(*)
    end function
    integer(c_int) function c_report(client, key, number, total) bind(c, name="CoracleReport")
      import; type(c_ptr), value :: client; character(c_char), intent(in) :: key(*)
      real(c_double), value :: number; integer(c_int), value :: total
    end function
    integer(c_int) function c_phase(client, name) bind(c, name="CoraclePhase")
      import; type(c_ptr), value :: client; character(c_char), intent(in) :: name(*)
    end function
    integer(c_int) function c_case_open(argc, argv, fail, client, case) bind(c, name="CoracleCaseOpen")
      import; integer(c_int), value :: argc; type(c_ptr), intent(in) :: argv(*); type(c_funptr), value :: fail
      type(c_ptr), value :: client; type(c_ptr), intent(out) :: case
    end function
    logical(c_bool) function c_case_has(case, key) bind(c, name="CoracleCaseHas")
      import; type(c_ptr), value :: case; character(c_char), intent(in) :: key(*)
    end function
    integer(c_int) function c_case_count(case, key) bind(c, name="CoracleCaseCount")
      import; type(c_ptr), value :: case; character(c_char), intent(in) :: key(*)
    end function
    real(c_double) function c_case_number(case, key, lower, upper) bind(c, name="CoracleCaseNumber")
      import; type(c_ptr), value :: case; character(c_char), intent(in) :: key(*); real(c_double), value :: lower, upper
    end function
    real(c_double) function c_case_positive(case, key) bind(c, name="CoracleCasePositive")
      import; type(c_ptr), value :: case; character(c_char), intent(in) :: key(*)
    end function
    integer(c_int) function c_case_integer(case, key, default, lower, upper) bind(c, name="CoracleCaseIntegerOr")
      import; type(c_ptr), value :: case; character(c_char), intent(in) :: key(*)
      integer(c_int), value :: default, lower, upper
    end function
    subroutine c_case_vector(case, key, n, v) bind(c, name="CoracleCaseVector")
      import; type(c_ptr), value :: case; character(c_char), intent(in) :: key(*); integer(c_int), value :: n
      real(c_double), intent(out) :: v(*)
    end subroutine
    type(c_ptr) function c_case_string(case, key) bind(c, name="CoracleCaseString")
      import; type(c_ptr), value :: case; character(c_char), intent(in) :: key(*)
    end function
    integer(c_size_t) function c_strlen(s) bind(c, name="strlen")
      import; type(c_ptr), value :: s
    end function
    integer(c_int) function c_get_force(client, force) bind(c, name="CoracleGetForce")
      import; type(c_ptr), value :: client; type(c_ptr), intent(out) :: force
    end function
    integer(c_int) function c_get_film(client, load, resistance) bind(c, name="CoracleGetFilm")
      import; type(c_ptr), value :: client; type(c_ptr), intent(out) :: load, resistance
    end function
    integer(c_int) function c_get_coupling(client, n, coupling) bind(c, name="CoracleGetCoupling")
      import; type(c_ptr), value :: client; integer(c_int), intent(out) :: n; type(c_ptr), intent(out) :: coupling
    end function
    integer(c_int) function c_get_correction(client, n, correction) bind(c, name="CoracleGetCorrection")
      import; type(c_ptr), value :: client; integer(c_int), intent(out) :: n; type(c_ptr), intent(out) :: correction
    end function
    integer(c_int) function c_get_gauges(client, n, gauge) bind(c, name="CoracleGetGauges")
      import; type(c_ptr), value :: client; integer(c_int), intent(out) :: n; type(c_ptr), intent(out) :: gauge
    end function
  end interface
  private :: c_open, c_fail, c_report, c_phase, c_case_open, c_case_has, c_case_count, c_case_number, c_case_positive, &
    c_case_integer, c_case_vector, c_case_string, c_strlen, c_get_force, c_get_film, c_get_coupling, &
    c_get_correction, c_get_gauges

  ! C's functions as they are; each returns 0
  interface
    integer(c_int) function CoracleClose(client) bind(c, name="CoracleClose")
      import; type(c_ptr), intent(inout) :: client
    end function
    integer(c_int) function CoracleCaseClose(case) bind(c, name="CoracleCaseClose")
      import; type(c_ptr), intent(inout) :: case
    end function
    integer(c_int) function CoracleBindState(client, state, bytes) bind(c, name="CoracleBindState")
      import; type(c_ptr), value :: client, state; integer(c_size_t), value :: bytes
    end function
    integer(c_int) function CoracleBindStateFunction(client, f, context) bind(c, name="CoracleBindStateFunction")
      import; type(c_ptr), value :: client, context; type(c_funptr), value :: f
    end function
    integer(c_int) function CoracleReady(client) bind(c, name="CoracleReady")
      import; type(c_ptr), value :: client
    end function
    integer(c_int) function CoracleBegin(client, t, dt, action) bind(c, name="CoracleBegin")
      import; type(c_ptr), value :: client; real(c_double), intent(out) :: t, dt; integer(c_int), intent(out) :: action
    end function
    integer(c_int) function CoracleEnd(client, x) bind(c, name="CoracleEnd")
      import; type(c_ptr), value :: client; real(c_double), intent(in), optional :: x(*)
    end function
    ! the solid
    integer(c_int) function CoracleSetNodes(client, dim, n, gid, x, u) bind(c, name="CoracleSetNodes")
      import; type(c_ptr), value :: client; integer(c_int), value :: dim, n
      integer(c_long_long), intent(in) :: gid(*); real(c_double), intent(in) :: x(*), u(*)
    end function
    integer(c_int) function CoracleSetSurface(client, ne, conn) bind(c, name="CoracleSetSurface")
      import; type(c_ptr), value :: client; integer(c_int), value :: ne; integer(c_int), intent(in) :: conn(*)
    end function
    integer(c_int) function CoracleSetVolume(client, ne, conn) bind(c, name="CoracleSetVolume")
      import; type(c_ptr), value :: client; integer(c_int), value :: ne; integer(c_int), intent(in) :: conn(*)
    end function
    integer(c_int) function CoracleSetInertia(client, mobility, acceleration) bind(c, name="CoracleSetInertia")
      import; type(c_ptr), value :: client; real(c_double), intent(in) :: mobility(*), acceleration(*)
    end function
    integer(c_int) function CoracleSetPressureLoad(client) bind(c, name="CoracleSetPressureLoad")
      import; type(c_ptr), value :: client
    end function
    integer(c_int) function CoracleSubstep(client, h, u) bind(c, name="CoracleSubstep")
      import; type(c_ptr), value :: client; real(c_double), value :: h; real(c_double), intent(in) :: u(*)
    end function
    integer(c_int) function CoracleSetVelocity(client, u) bind(c, name="CoracleSetVelocity")
      import; type(c_ptr), value :: client; real(c_double), intent(in) :: u(*)
    end function
    ! the fluid
    integer(c_int) function CoracleGetRegion(client, nbox, box) bind(c, name="CoracleGetRegion")
      import; type(c_ptr), value :: client; integer(c_int), intent(out) :: nbox; type(c_ptr), intent(out) :: box
    end function
    integer(c_int) function CoracleSetRegion(client, dim, lower, upper, region, context) bind(c, name="CoracleSetRegion")
      import; type(c_ptr), value :: client, context; integer(c_int), value :: dim
      real(c_double), intent(in) :: lower(*), upper(*); type(c_funptr), value :: region
    end function
    integer(c_int) function CoracleElementsChanged(client) bind(c, name="CoracleElementsChanged")
      import; type(c_ptr), value :: client
    end function
    integer(c_int) function CoracleProposeStep(client, dt) bind(c, name="CoracleProposeStep")
      import; type(c_ptr), value :: client; real(c_double), value :: dt
    end function
    integer(c_int) function CoracleNeedsPressure(client) bind(c, name="CoracleNeedsPressure")
      import; type(c_ptr), value :: client
    end function
    integer(c_int) function CoracleSetFlow(client, flow) bind(c, name="CoracleSetFlow")
      import; type(c_ptr), value :: client; type(CoracleFlow), intent(in) :: flow
    end function
    integer(c_int) function CoracleStepAccepted(client) bind(c, name="CoracleStepAccepted")
      import; type(c_ptr), value :: client
    end function
  end interface

contains

  !> The command line as C's argc and argv; both arrays must live as long as argv is used.
  subroutine arguments(text, argv)
    character(c_char), allocatable, target, intent(out) :: text(:)
    type(c_ptr), allocatable, intent(out) :: argv(:)
    character(4096) :: word
    integer :: k, i, length, at
    allocate(text(0), argv(command_argument_count() + 2))
    do k = 0, command_argument_count()
      call get_command_argument(k, word, length)
      text = [text, (word(i:i), i = 1, length), c_null_char]
    end do
    at = 1
    do k = 1, size(argv) - 1
      argv(k) = c_loc(text(at))
      do while (text(at) /= c_null_char)
        at = at + 1
      end do
      at = at + 1
    end do
    argv(size(argv)) = c_null_ptr
  end subroutine

  !> Joins the job as role "fluid" or "solid"; comm is the participant's communicator, a handle of MPI's Fortran interface.
  !> job: that of the participants' ranks (default: MPI_COMM_WORLD).
  subroutine coracle_open(role, comm, client, job)
    character(*), intent(in) :: role
    integer(c_int), intent(out) :: comm
    type(c_ptr), intent(out) :: client
    integer(c_int), intent(in), target, optional :: job
    character(c_char), allocatable, target :: text(:)
    type(c_ptr), allocatable :: argv(:)
    type(c_ptr) :: base
    integer(c_int) :: ignored
    base = c_null_ptr
    if (present(job)) base = c_loc(job)
    call arguments(text, argv)
    ignored = c_open(base, trim(role)//c_null_char, size(argv) - 1, argv, comm, client)
  end subroutine

  subroutine coracle_fail(client, message)
    type(c_ptr), intent(in) :: client
    character(*), intent(in) :: message
    call c_fail(client, trim(message)//c_null_char)
  end subroutine

  !> The step cannot be made; CoracleEnd follows all the same.
  subroutine coracle_reject_step(client, why)
    type(c_ptr), intent(in) :: client
    character(*), intent(in) :: why
    integer(c_int) :: ignored
    ignored = c_reject_step(client, trim(why)//c_null_char)
  end subroutine

  subroutine coracle_report(client, key, number, total)
    type(c_ptr), intent(in) :: client
    character(*), intent(in) :: key
    real(c_double), intent(in) :: number
    logical, intent(in) :: total
    integer(c_int) :: ignored
    ignored = c_report(client, trim(key)//c_null_char, number, merge(1, 0, total))
  end subroutine

  !> What this rank computes from now on, in the run's trace; blank: nothing.
  subroutine coracle_phase(client, name)
    type(c_ptr), intent(in) :: client
    character(*), intent(in) :: name
    integer(c_int) :: ignored
    ignored = c_phase(client, trim(name)//c_null_char)
  end subroutine

  !> force(dim, n), N, a pointer to the library's memory until CoracleEnd.
  subroutine coracle_get_force(client, n, force)
    type(c_ptr), intent(in) :: client
    integer, intent(in) :: n
    real(c_double), pointer, intent(out) :: force(:, :)
    type(c_ptr) :: memory
    integer(c_int) :: ignored
    ignored = c_get_force(client, memory)
    nullify(force)
    if (n > 0) call c_f_pointer(memory, force, [CORACLE_DIM, n])
    if (n == 0) allocate(force(CORACLE_DIM, 0))
  end subroutine

  !> load(dim, n), N, and resistance(dim, dim, n), N s/m, pointers to the library's memory until CoracleEnd; null where no film yields.
  subroutine coracle_get_film(client, n, load, resistance)
    type(c_ptr), intent(in) :: client
    integer, intent(in) :: n
    real(c_double), pointer, intent(out) :: load(:, :), resistance(:, :, :)
    type(c_ptr) :: memory(2)
    integer(c_int) :: ignored
    ignored = c_get_film(client, memory(1), memory(2))
    nullify(load, resistance)
    if (.not. c_associated(memory(1))) return
    call c_f_pointer(memory(1), load, [CORACLE_DIM, n])
    call c_f_pointer(memory(2), resistance, [CORACLE_DIM, CORACLE_DIM, n])
  end subroutine

  !> The entries of the coming step's coupling, a pointer to the library's memory until CoracleEnd.
  subroutine coracle_get_coupling(client, coupling)
    type(c_ptr), intent(in) :: client
    type(CoracleCoupling), pointer, intent(out) :: coupling(:)
    type(c_ptr) :: memory
    integer(c_int) :: n, ignored
    ignored = c_get_coupling(client, n, memory)
    if (n > 0) call c_f_pointer(memory, coupling, [n])
    if (n == 0) allocate(coupling(0))
  end subroutine

  !> One entry for each of the coupling's of the step just made, until the next CoracleEnd.
  subroutine coracle_get_correction(client, correction)
    type(c_ptr), intent(in) :: client
    type(CoracleCorrection), pointer, intent(out) :: correction(:)
    type(c_ptr) :: memory
    integer(c_int) :: n, ignored
    ignored = c_get_correction(client, n, memory)
    if (n > 0) call c_f_pointer(memory, correction, [n])
    if (n == 0) allocate(correction(0))
  end subroutine

  !> The gauges at the end of the step just made, until the next CoracleEnd.
  subroutine coracle_get_gauges(client, gauge)
    type(c_ptr), intent(in) :: client
    type(CoracleGauge), pointer, intent(out) :: gauge(:)
    type(c_ptr) :: memory
    integer(c_int) :: n, ignored
    ignored = c_get_gauges(client, n, memory)
    if (n > 0) call c_f_pointer(memory, gauge, [n])
    if (n == 0) allocate(gauge(0))
  end subroutine

  !> The case file; what is wrong in it ends the job with file, line and key.  Closed by CoracleCaseClose.
  subroutine coracle_case_open(client, case)
    type(c_ptr), intent(in) :: client
    type(c_ptr), intent(out) :: case
    character(c_char), allocatable, target :: text(:)
    type(c_ptr), allocatable :: argv(:)
    integer(c_int) :: ignored
    call arguments(text, argv)
    ignored = c_case_open(size(argv) - 1, argv, c_funloc(c_fail), client, case)
  end subroutine

  logical function coracle_case_has(case, key)
    type(c_ptr), intent(in) :: case; character(*), intent(in) :: key
    coracle_case_has = c_case_has(case, key//c_null_char)
  end function

  integer function coracle_case_count(case, key)
    type(c_ptr), intent(in) :: case; character(*), intent(in) :: key
    coracle_case_count = c_case_count(case, key//c_null_char)
  end function

  real(c_double) function coracle_case_number(case, key)
    type(c_ptr), intent(in) :: case; character(*), intent(in) :: key
    coracle_case_number = c_case_number(case, key//c_null_char, -huge(1.0_c_double), huge(1.0_c_double))
  end function

  real(c_double) function coracle_case_positive(case, key)
    type(c_ptr), intent(in) :: case; character(*), intent(in) :: key
    coracle_case_positive = c_case_positive(case, key//c_null_char)
  end function

  integer function coracle_case_integer(case, key, default)
    type(c_ptr), intent(in) :: case; character(*), intent(in) :: key
    integer, intent(in) :: default
    coracle_case_integer = c_case_integer(case, key//c_null_char, default, -huge(1), huge(1))
  end function

  subroutine coracle_case_vector(case, key, v)
    type(c_ptr), intent(in) :: case; character(*), intent(in) :: key
    real(c_double), intent(out) :: v(:)
    real(c_double) :: values(size(v))
    call c_case_vector(case, key//c_null_char, size(v), values)
    v = values
  end subroutine

  function coracle_case_string(case, key) result(text)
    type(c_ptr), intent(in) :: case; character(*), intent(in) :: key
    character(:), allocatable :: text
    character(c_char), pointer :: memory(:)
    type(c_ptr) :: string
    integer :: i
    string = c_case_string(case, key//c_null_char)
    call c_f_pointer(string, memory, [int(c_strlen(string))])
    allocate(character(size(memory)) :: text)
    do i = 1, size(memory)
      text(i:i) = memory(i)
    end do
  end function

end module coracle
