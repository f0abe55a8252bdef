// Laminar incompressible flow by OpenFOAM, in place of coracle-fluid: finite volumes, implicit Euler steps, one pressure
// correction a step.  fluid.openfoam (foam in output.folder by default) is the folder of an OpenFOAM case with a mesh one cell
// thick, U and p, the pressure without its hydrostatic part over the density; for more ranks it has been decomposed.
#include "cells.h"
#include "ranks.h"
#include <case_file.h>

using namespace Foam;

struct Input {
  std::string folder;
  double rho, mu, dt_max, cfl, every, gravity[2];
  Input(CoracleClient client, int argc, char **argv)
  {
    static const char *const SECTIONS[] = {"fluid", nullptr};
    CoracleCase c;
    CoracleCaseOpen(argc, argv, CoracleFailMessage, client, &c);
    folder = CoracleCaseHas(c, "fluid.openfoam") ? CoracleCaseFile(c, "fluid.openfoam") : CoracleCaseString(c, "output.folder") + std::string("/foam");
    rho = CoracleCasePositive(c, "fluid.density"), mu = CoracleCasePositive(c, "fluid.viscosity");
    dt_max = CoracleCasePositive(c, "time.dt_max"), cfl = CoracleCasePositive(c, "time.cfl");
    every = CoracleCasePositive(c, "output.every");
    CoracleCaseVector(c, "gravity", 2, gravity);
    CoracleCaseFinish(c, SECTIONS);
    CoracleCaseClose(&c);
  }
};

class Flow
{
public:
  Flow(CoracleClient client, const Input &in, Time &time);
  void step(double t, double dt);

private:
  void predict(double dt);
  void project(double dt);
  // calls f(value) for each number of the state
  template <class F> void forState(F f)
  {
    for (vector &u : U.primitiveFieldRef())
      for (int d = 0; d < 2; d++) f(u[d]);
    for (double &v : p.primitiveFieldRef()) f(v);
    for (double &v : phi.primitiveFieldRef()) f(v);
    for (auto &patch : phi.boundaryFieldRef())
      for (double &v : patch) f(v);
  }
  void restore()
  {
    const double *from = state_.data();
    forState([&](double &v) { v = *from++; });
    U.correctBoundaryConditions(), p.correctBoundaryConditions();
  }
  void propose()
  {
    const scalarField rate(0.5 * fvc::surfaceSum(mag(phi))().primitiveField() / mesh_.V().field());
    CoracleProposeStep(client_, Foam::min(in_.dt_max, in_.cfl / Foam::max(gMax(rate), VSMALL)));
  }

  CoracleClient client_;
  Input in_;
  Time &time_;
  fvMesh mesh_;
  Cells cells_;
  volScalarField p;
  volVectorField U;
  surfaceScalarField phi;
  volVectorField grad_p_, start_, star_; // both of the step's start; U*
  volTensorField grad_U_;                // of U*
  std::vector<double> state_;            // U, p and phi by cells and faces, which a step changes; the library restores them when it is redone
  int steps_ = 0;
};

Flow::Flow(CoracleClient client, const Input &in, Time &time)
    : client_(client), in_(in), time_(time),
      mesh_(IOobject(fvMesh::defaultRegion, time.timeName(), time, IOobject::MUST_READ)), cells_(mesh_, in.rho, in.mu),
      p(IOobject("p", time.timeName(), mesh_, IOobject::MUST_READ, IOobject::AUTO_WRITE), mesh_),
      U(IOobject("U", time.timeName(), mesh_, IOobject::MUST_READ, IOobject::AUTO_WRITE), mesh_),
      phi("phi", fvc::flux(U)), grad_p_(fvc::grad(p)), start_("start", U), star_("star", U), grad_U_(fvc::grad(U))
{
  mesh_.setFluxRequired("p");
  forState([&](double &v) { state_.push_back(v); });
  CoracleBindState(client, state_.data(), state_.size() * sizeof(double));
  restore(); // in a run that resumes it is another
  propose();
  CoracleSetRegion(client, CORACLE_DIM, &mesh_.bounds().min()[0], &mesh_.bounds().max()[0], Cells::region, &cells_);
  CoracleReady(client);
}

// (U* - U)/dt + inertia (tensor U* - kept U) + k U* + div(phi U*) - nu laplacian U* = force - grad p; what force has beyond k follows in
// iterations; the matrix has the inertia's trace, and then each cell is solved with its tensor, the neighbours as they are
void Flow::predict(double dt)
{
  const dimensionedScalar per_dt("1/dt", dimless / dimTime, 1.0 / dt), nu("nu", dimViscosity, in_.mu / in_.rho);
  start_ = U;
  volScalarField k(IOobject("k", time_.timeName(), mesh_), mesh_, per_dt);
  volVectorField force("force", 0.0 * per_dt * U);
  k.primitiveFieldRef() += cells_.k + tr(cells_.inertia_tensor);
  const tensorField rest(tr(cells_.inertia_tensor) * tensor::I - cells_.inertia_tensor);
  const vectorField start((1.0 - cells_.covered) / dt * U.primitiveField() + (cells_.kept_inertia & U.primitiveField()));
  grad_p_ = fvc::grad(p), grad_U_ = fvc::grad(U);
  for (int iteration = 0; iteration < 4; iteration++) {
    const vectorField deferred(rest & U.primitiveField());
    force.primitiveFieldRef() = start + cells_.force(U, grad_U_) + deferred;
    fvVectorMatrix momentum(fvm::Sp(k, U) + fvm::div(phi, U) - fvm::laplacian(nu, U) == force - grad_p_);
    momentum.solve();
    const vectorField others(momentum.H()().primitiveField() - deferred); // a temporary would be overwritten while it is read
    U.primitiveFieldRef() = inv(tensorField(momentum.A()().primitiveField() * tensor::I - rest)) & others;
    U.correctBoundaryConditions(), grad_U_ = fvc::grad(U);
  }
  star_ = U;
}

// U = U* - D grad(p - p of the step's start), D = (1/dt + implicit inertia times its tensor)^-1.  The flux is that of the bulk velocity, with the
// pressure's difference across the face in place of the cells' gradients; it has no divergence.
void Flow::project(double dt)
{
  volTensorField D(IOobject("D", time_.timeName(), mesh_), mesh_, dimensionedTensor("dt", dimTime, dt * tensor(tensor::I)));
  D.primitiveFieldRef() = inv(tensorField(tensor::I / dt + cells_.inertia_tensor));
  D.correctBoundaryConditions();
  volVectorField bulk("bulk", star_ + (D & grad_p_));
  const vectorField without_pressure(bulk.primitiveField());
  bulk.primitiveFieldRef() += cells_.us - cells_.ms * star_.primitiveField();
  bulk.correctBoundaryConditions();
  phi = fvc::flux(constrainHbyA(bulk, U, p));
  adjustPhi(phi, U, p);
  fvScalarMatrix pressure(fvm::laplacian(D, p) == fvc::div(phi));
  pressure.setReference(UPstream::master() ? 0 : -1, 0.0);
  pressure.solve();
  phi -= pressure.flux();
  U.primitiveFieldRef() = without_pressure - (D.primitiveField() & fvc::grad(p)().primitiveField());
}

void Flow::step(double t, double dt)
{
  const vector g(in_.gravity[0], in_.gravity[1], 0);
  restore();
  cells_.receive(client_);
  if (t == 0.0) cells_.begin(U.primitiveFieldRef());
  CoraclePhase(client_, "momentum");
  predict(dt);
  CoraclePhase(client_, "pressure");
  project(dt);
  const vectorField grad_p(fvc::grad(p)().primitiveField() + g);
  cells_.give(client_, start_, star_, U, grad_U_, p.primitiveField() + (g & mesh_.C().primitiveField()), grad_p);
  propose();
  CoracleEnd(client_, nullptr);
  if (!CoracleStepAccepted(client_)) return;
  cells_.correct(client_, U.primitiveFieldRef());
  U.correctBoundaryConditions();
  double *to = state_.data();
  forState([&](double &v) { *to++ = v; });
  time_.setTime(t + dt, ++steps_);
  if (std::floor((t + dt) / in_.every + 1e-9) > std::floor(t / in_.every + 1e-9)) time_.writeNow();
}

int main(int argc, char **argv)
{
  CoracleClient client;
  MPI_Comm comm;
  CoracleOpen("fluid", argc, argv, &comm, &client);
  const Input in(client, argc, argv);
  StartPstream(comm, argc, argv);
  FatalError.throwExceptions(), FatalIOError.throwExceptions();
  try {
    const fileName folder(in.folder);
    Time time(Time::controlDictName, folder.path(), UPstream::parRun() ? fileName(folder.name()) / "processor" + name(UPstream::myProcNo()) : folder.name());
    Flow flow(client, in, time);
    CoracleAction action;
    double t, dt;
    for (CoracleBegin(client, &t, &dt, &action); action != CORACLE_STOP; CoracleBegin(client, &t, &dt, &action)) flow.step(t, dt);
  } catch (const Foam::error &error) {
    CoracleFail(client, "OpenFOAM: %s", error.message().c_str());
  }
  return CoracleClose(&client);
}
