#include "app/reports/glossary.h"

#include <array>

namespace hoplab {
namespace {

constexpr std::array kWords = {
    GlossaryEntry{"adequate", "",
                  "Verdict of a diagnosis: nothing is missing that these data could show. The "
                  "largest score of all causes is no larger than noise alone brings about (global "
                  "p > 0.01), or the evidence for no cause overcomes the prior odds against it.",
                  "Use the model as it is, for motions like the recorded ones. Adequate is not "
                  "complete: causes listed as not-tested could be there unseen; a trial with more "
                  "speed, height or torque shows more."},
    GlossaryEntry{"apex", "",
                  "The highest point of a hop, where vy = 0 in flight. Its state is the "
                  "speed vx [m/s] and the height y [m]; a hop goes from one apex to the "
                  "next.",
                  "Tables count hops from apex to apex and compare apex heights, because "
                  "there the energy reads off as m (vx^2/2 + g y). An apex too low for "
                  "the leg to swing through ends a run as a fall."},
    GlossaryEntry{"at-bound", "bound",
                  "A fitted value that ended on a limit physics sets, as d = 0. The "
                  "optimum would lie beyond; there is no symmetric interval.",
                  "Either the value is really there, or another cause wants it to be: a "
                  "damping of zero says that energy is lost elsewhere, or put in. Ask "
                  "hoplab diagnose, or take a one-sided interval with --profile."},
    GlossaryEntry{"between-trials", "between-hops sandwich",
                  "An interval from how differently the trials (or hops) pull at a value,"
                  " not from the stated noise: the sandwich estimate, with Student's t on"
                  " trials - 1 degrees of freedom.",
                  "The one to quote where the model misses more than the noise. If it is "
                  "much wider than the interval from noise, trials disagree: diagnose "
                  "them, or look for one that differs."},
    GlossaryEntry{"candidate", "cause",
                  "One physical effect of the catalogue that a diagnosis tries in the "
                  "model. Each is scored at the null fit, then refitted together with "
                  "everything else.",
                  "hoplab effects lists them, --effects and --without choose. Every named"
                  " cause may stand for something outside the catalogue that moves the "
                  "data as it does."},
    GlossaryEntry{"chi2", "chi-square chi2-per-sample",
                  "Sum of squares of the residuals, each over its standard deviation; per"
                  " sample, 1 is expected [-]. chi2 = sum ((simulated - "
                  "measured)/sigma)^2 / (samples - parameters).",
                  "Near 1 the model is as good as the noise lets you see. Above, the "
                  "model misses something (see misfit), or sigma is stated too small; "
                  "below, sigma is too large. hoplab check prints both sigmas."},
    GlossaryEntry{"condition-number", "",
                  "How unevenly the data fix the parameters: largest over smallest "
                  "singular value of the sensitivities J, each column in units of its "
                  "parameter's scale [-]. 1 is ideal.",
                  "Up to about 100 all is well. From 1e4 on some combination is known far"
                  " worse than the rest: look at the weak-direction, hold a value you "
                  "know (--fix g=9.81), or record a trial that excites it."},
    GlossaryEntry{"confidence-interval", "interval ci95",
                  "A range that would cover the true value in 95 of 100 repetitions, if "
                  "the model is right: value -+ 1.96 standard errors, in the value's "
                  "unit.",
                  "It knows the noise, not the faults of the model. Where the fit says "
                  "that the model misses more than the noise, go by the interval between-"
                  "trials, and even that one cannot see an error that all trials share."},
    GlossaryEntry{"confounded", "",
                  "Verdict of a diagnosis: something is missing, and several causes may be it, or "
                  "one with a probability below 0.95. A group of names that cannot be told apart "
                  "holds 95 % of the evidence in its place.",
                  "Do not pick the one you like. The report shows whether they predict alike (then "
                  "the choice does not matter here) and proposes a trial to record that sets them "
                  "apart (separating-experiment)."},
    GlossaryEntry{"contact", "",
                  "The point of the ground that carries the leg, x_c [m]; in a dataset "
                  "the channel contact tells when there is one.",
                  "With the channel, touch-down and lift-off times join the fit; without "
                  "it they are inferred from the motion. Give it if you have a switch or "
                  "a force plate: it pins damping and offsets."},
    GlossaryEntry{"convergence-time", "",
                  "Time until the speed of a controlled hopper stays within 1 % of its "
                  "steady value [s], counted at apexes (M23).",
                  "Smaller is better for a controller. It jumps by whole hops, so an "
                  "optimum may sit on an edge: look at the robustness table and the map "
                  "before you build it."},
    GlossaryEntry{"delta80", "",
                  "The size of an effect that these data would detect with 80 % power at "
                  "the 5 % level: delta80 = 2.8/sqrt(V), V what of its column remains "
                  "after the fitted values are projected out; in the effect's unit.",
                  "Effects well below it are invisible here, whatever their truth. To see"
                  " smaller ones: more trials, less noise, or motions that excite the "
                  "effect; the size falls as one over the root of the samples."},
    GlossaryEntry{"discrepancy", "left matern",
                  "A smooth error of the model beside white noise: a Gaussian process (Matern 3/2) "
                  "in each trial and channel, with an amplitude per channel and one time scale.",
                  "What is left after the causes found. A small one makes intervals honest; a "
                  "material one says that something is missing, and keeps causes from being "
                  "excluded. Switch it off with --discrepancy none."},
    GlossaryEntry{"energy-ledger", "energy",
                  "What energy goes where in each hop: m (v^2/2 + g y) at one apex less "
                  "that at the next [J], measured, simulated before and simulated after "
                  "an extension.",
                  "A model that loses too little or too much shows here first, and in "
                  "which hop. A loss the model lacks wants a dissipative effect; a gain "
                  "means a law that does not conserve energy, or a motor that pushes."},
    GlossaryEntry{
        "excluded", "",
        "Judgement on a cause: it was tested and is not needed, and nothing material is left that "
        "could hide it. Beyond the size told, 95 % of repetitions would have shown it.",
        "You may say that the effect is smaller than the bound in these trials, no more. A bound "
        "larger than what matters to you calls for another trial."},
    GlossaryEntry{"extension", "",
                  "The model with the named effects added and everything refitted; their "
                  "sizes become parameters beside the old ones.",
                  "Look at how the old values moved: that is the bias the missing cause "
                  "had put into them. Keep an extension only if the held-out error falls;"
                  " simulate with it by --with effect:parameter=value."},
    GlossaryEntry{"fixed-point", "steady-hop limit-cycle",
                  "A steady hop: an apex state (vx, y) that the next apex repeats, P(x) ="
                  " x for the return-map P.",
                  "It exists whether stable or not; the multipliers say which. hoplab "
                  "gait finds it, also where the hopper itself would never settle, and "
                  "follows it along a parameter with --along."},
    GlossaryEntry{"flight", "",
                  "The mode without contact: only gravity acts, unless an effect pushes "
                  "the body (M13, M14 without F and T).",
                  "A misfit in flight is no fault of the leg: suspect gravity, the clock,"
                  " the camera or the air before you change a stiffness."},
    GlossaryEntry{"floquet-multiplier", "multiplier multipliers eigenvalue",
                  "Factor by which a small disturbance of a steady hop grows per hop: an "
                  "eigenvalue of the return map's Jacobian [-], real or a complex pair.",
                  "Inside the unit circle a disturbance dies out, at 0 in one hop; "
                  "outside the hopper falls. -1 warns of alternating hops, +1 of a fold "
                  "where the steady hop disappears; 1 exactly is a conserved quantity, as"
                  " energy."},
    GlossaryEntry{"free-force", "probe",
                  "A force, impulse or offset without a physical name, fitted as bumps "
                  "over deflection, leg angle or time to what the model leaves [N, N s, "
                  "m].",
                  "It shows what the missing part looks like where no effect of the "
                  "catalogue fits. It describes and does not explain: use its shape to "
                  "guess a mechanism, and write that down as an effect."},
    GlossaryEntry{"gradient-certificate", "gradient-check",
                  "A check of every derivative the fit used: sensitivities against "
                  "Richardson differences of simulations at 1e-12, relative to the "
                  "column's norm [-].",
                  "Below 1e-4 a diagnosis accepts them; 1e-8 is usual. A larger one, or a"
                  " flag (an event grazes, two coincide), means that intervals and scores"
                  " at this place are not to be trusted: move the start or the parameter "
                  "a little."},
    GlossaryEntry{"grazing", "",
                  "An event that is met without being crossed: the guard reaches zero "
                  "with almost no rate, as a foot that just touches.",
                  "There the outcome has no derivative, so a fit or a branch ends there. "
                  "It is a property of the motion; a trial with a little more height or "
                  "speed avoids it."},
    GlossaryEntry{"held-out", "test test-error held-out-error",
                  "Of trials that took no part in the fit (role: test). Their start "
                  "states are refitted under their prior, the shared parameters stay.",
                  "The honest error. If it is much larger than the train error the model "
                  "has learnt its trials; if it falls with an extension, the cause is "
                  "real enough to predict. Keep a third of the trials for it, some of "
                  "them excited differently."},
    GlossaryEntry{"held-out-gain", "gain",
                  "Log-likelihood that an extension gains per sample of the held-out "
                  "trials [nats], with a 95 % interval from a bootstrap over hops.",
                  "Only an interval wholly above zero is claimed as a gain. With fewer "
                  "than four held-out hops there is no interval: record more test trials."},
    GlossaryEntry{"identifiability", "determined",
                  "Whether the data fix each parameter, apart from the others: from the "
                  "singular values of the sensitivities with the trials' starts projected"
                  " out.",
                  "hoplab check tells before any fit. What is not determined gets no "
                  "interval instead of a wide guess; hold it with --fix, or add a channel"
                  " or a trial that sees it."},
    GlossaryEntry{"indistinguishable", "",
                  "Judgement on a cause: in the place of a supported one it may be right as well. "
                  "It belongs to the smallest group that holds 95 % of the evidence there.",
                  "The data do not choose. See confounded and separating-experiment; knowledge "
                  "from outside, as a weighed mass, may choose for you."},
    GlossaryEntry{"liftoff", "lift-off",
                  "The event that ends stance: the chord force comes down to zero (the "
                  "default), or the chord regains its rest length.",
                  "With damping the two differ, and the first leaves a leg still pressed."
                  " Choose by liftoff in the scenario; the difference shows in stance "
                  "times."},
    GlossaryEntry{"likelihood", "nats log-likelihood nll",
                  "How probable the model makes the data, in natural logarithms [nats]; "
                  "nll is its negative per sample, Gaussian with the stated sigma.",
                  "3 nats are odds of 20 to 1, 10 nats of 22000 to 1, if residuals are "
                  "independent. Real residuals are not quite, so believe held-out gains "
                  "before gains on train trials."},
    GlossaryEntry{"main-cause", "main",
                  "A cause that explains at least 2 % of the misfit, or without which a held-out "
                  "error is a tenth larger, and which the held-out trials confirm: by a clear gain "
                  "or, of a cause of 2 %, by an error that is a quarter larger without it.",
                  "Act on these. The other causes of an extension are small corrections the data "
                  "also want; they may stand for details of the model."},
    GlossaryEntry{"misfit", "",
                  "More residual than noise explains: chi-square of the whole fit has a "
                  "probability below 0.001.",
                  "The parameters are then the best of a wrong model, biased to make up "
                  "for it. hoplab diagnose says where the misfit sits and which cause "
                  "would remove it."},
    GlossaryEntry{
        "named", "",
        "Verdict of a diagnosis: one cause (or set) explains what is missing, nothing else in the "
        "catalogue does as well, and of simulated cases that looked like this one 95 % or more had "
        "the right name.",
        "Read it as 'this, or something outside the catalogue that moves the data like it'. "
        "Confirm on the rig as hoplab explain EFFECT suggests, then refit --with it."},
    GlossaryEntry{"not-needed", "",
                  "Judgement on a cause: it was tested and is not needed beside the causes found, "
                  "but something is left that may hide it. No bound is told.",
                  "Say nothing about its size. First find what is left: the free forces show where "
                  "it acts, and another trial may tell more."},
    GlossaryEntry{"not-tested", "",
                  "Judgement on a cause: at its typical size these data could not have "
                  "shown it (typical size below delta80).",
                  "Silence about it means nothing. If you suspect it, excite it: the "
                  "effect's text says how, and the size needed stands beside it."},
    GlossaryEntry{"p-value", "p",
                  "Probability that noise alone brings about something as large [-]; for "
                  "a diagnosis, the largest score of all causes in simulated noise.",
                  "Below 0.01 something is missing. It says nothing of the size or the "
                  "cause; with many samples tiny faults have tiny p. Compare what the "
                  "fault costs: the held-out error."},
    GlossaryEntry{
        "penalty", "prior-odds",
        "Prior odds against a cause [nats]: beforehand one cause is expected in all that could "
        "show, so each of n starts with odds of about 1 to n.",
        "The evidence must overcome them before a cause is worth naming. Fewer candidates "
        "(--effects) lower them, honestly only if you choose them before seeing the data."},
    GlossaryEntry{"probability", "P unlisted",
                  "Chance that a name is right: the weight of the evidence between models, times "
                  "the share of right names among simulated cases that looked like this one.",
                  "Above 0.95 a cause is named. Between, several causes or something outside the "
                  "catalogue may be it; P unlisted is the chance of the latter."},
    GlossaryEntry{"profile", "profile-likelihood",
                  "chi-square as a function of one parameter, everything else refitted at"
                  " each value; its 95 % interval ends where chi-square has risen by "
                  "3.84, times what a discrepancy adds to the value's variance.",
                  "Exact where the symmetric interval is not: near a bound, or where the "
                  "curve leans. Ask with --profile NAME; it costs some tens of fits."},
    GlossaryEntry{"residual", "",
                  "Simulated minus measured, in the channel's unit, or over its standard "
                  "deviation where 'whitened'.",
                  "A good model leaves noise without a pattern. A wave in stance blames "
                  "the leg, a slope in flight the gravity or the camera, a jump at "
                  "contacts the touch-down."},
    GlossaryEntry{"return-map", "poincare-map",
                  "The map P that takes (vx, y) at one apex to the next; its derivative "
                  "comes from the simulation's sensitivities through every event.",
                  "It turns a hopper into a two-dimensional map: steady hops are its "
                  "fixed points, stability its multipliers. It does not exist for a leg "
                  "with a toe mass, whose toe has a state of its own."},
    GlossaryEntry{"rmse", "error",
                  "Root mean square of simulated minus measured, sqrt(mean((y_sim - "
                  "y)^2)), in the channel's unit; tables show millimetres for lengths.",
                  "Compare it with the channel's sigma: equal is perfect, ten times means"
                  " that the model, not the noise, is at fault. Judge by the held-out "
                  "one. Null where a simulation ends before its data."},
    GlossaryEntry{"rolling-stance", "rolling",
                  "The mode in which the half circle rolls on the ground: the contact "
                  "advances along the arc, phi < pi.",
                  "Stiffness changes as it rolls (M2), since less arc is loaded. How the "
                  "contact advances is what the laws of the leg disagree on."},
    GlossaryEntry{"saltation", "",
                  "The jump of sensitivities at an event: dx+/dp follows from dx-/dp, the"
                  " guard's gradient and the flows on both sides (M16, M17).",
                  "Nothing to set. It is why derivatives are exact through touch-down; "
                  "where it does not exist (see grazing) the run says so."},
    GlossaryEntry{"score", "",
                  "How far a cause alone would lower chi-square, to first order at the "
                  "null fit: (s'r)^2/(s'Ms) [-], s the cause's column, M the projection "
                  "off the fitted values.",
                  "It screens; large effects are misnamed by it, since they bend the "
                  "residual. So every candidate is refitted, and the judgement goes by "
                  "the refits."},
    GlossaryEntry{"sensitivity", "sensitivities",
                  "Derivative of the motion by a parameter, dx/dp, integrated along with "
                  "it and jumped at events [unit of x per unit of p].",
                  "The fit, its intervals and the diagnosis all rest on it; the gradient-"
                  "certificate checks it. hoplab simulate --sensitivities prints it."},
    GlossaryEntry{"separating-experiment", "",
                  "A trial to record next: touch-down angle, height, speed or torque for "
                  "which rival causes predict differently, by refits of the rivals on "
                  "simulated data.",
                  "Record it, add it to the dataset, diagnose again. Its expected nats "
                  "say how sure it will be: above 3 it should decide. hoplab design "
                  "searches further: mass, throws, hops back."},
    GlossaryEntry{"share", "explains",
                  "What a cause explains: the rise of the squared misfit when it is left out and "
                  "all else refitted, over the fall from the plain model to the extension.",
                  "Causes that can stand in for each other have shares that add to less than all. "
                  "The largest stands first."},
    GlossaryEntry{"sigma", "noise",
                  "Standard deviation of a channel's noise, in its unit; stated in the "
                  "dataset or estimated from short parabolas through the trace before any"
                  " fit.",
                  "Everything statistical hangs on it. State what the instrument has; "
                  "sigma: estimate asks the traces. Twice too small makes chi2 four times"
                  " too large and finds causes that are not there."},
    GlossaryEntry{"spectral-radius", "rho",
                  "Largest modulus of the multipliers of a steady hop [-].",
                  "Below 1 the hop is stable; the distance to it shrinks by this factor "
                  "per hop, so hops to 1 % are about ln(0.01/e0)/ln(rho). hoplab gait "
                  "gives its derivative by every parameter: what to change."},
    GlossaryEntry{"standard-error", "std-error",
                  "Standard deviation of a fitted value over repetitions of the noise, in"
                  " the value's unit: root of the diagonal of (J'J)^-1.",
                  "1.96 of them each way are the 95 % interval. A value that moved by "
                  "many when an effect was added had been biased by its absence."},
    GlossaryEntry{"supported", "",
                  "Judgement on a cause: the data want it, and nothing takes its place as"
                  " well.",
                  "It is in the extension. Its interval tells the size; confirm it on the"
                  " rig before you build on it."},
    GlossaryEntry{"toe-stance", "toe",
                  "The mode in which only the tip touches: phi = pi, the contact stays, "
                  "the leg turns about it like a spring on a pivot.",
                  "It begins when the rolled arc is used up, or at touch-down with a "
                  "touch-down-angle of 0 or below. Here all laws agree but for stiffness."},
    GlossaryEntry{"touchdown", "touch-down",
                  "The event that begins stance: the leg at its commanded angle meets the"
                  " ground (guard y - r (1 + cos theta_td) for a rolling start).",
                  "Millimetres in height or tenths of a degree in angle shift everything "
                  "after. Offsets, delays and the ground act here and look alike; contact"
                  " times tell them apart best."},
    GlossaryEntry{"touchdown-angle", "touch-down-angle theta_td",
                  "Angle theta_td of the leg as it lands [rad; deg in files]: of a half "
                  "circle from the horizontal to its tangent at the hip, of a straight "
                  "leg from the vertical to the leg.",
                  "Positive is ahead. A half circle lands rolling above 0, on its toe at "
                  "0 or below. The controller sets it in flight; an offset of it is the "
                  "effect touchdown_angle_bias."},
    GlossaryEntry{
        "unexplained", "",
        "Verdict of a diagnosis: something is missing, and the catalogue does not explain it: the "
        "best extension leaves too much, needs an unphysical size, or is less likely than a cause "
        "outside the catalogue while something is left.",
        "Look at where the misfit sits and at the free forces, guess a mechanism, and add it as an "
        "effect (docs/adding/effect.md). Do not quote the parameters as they are."},
    GlossaryEntry{"virtual-leg", "chord",
                  "The straight line from contact to hip: length l = sqrt(u^2 + y^2) [m],"
                  " angle alpha = atan2(u, y) from the vertical [rad].",
                  "The arc's spring acts along it, so a rolling half circle is a spring "
                  "of changing stiffness and pivot. Its length minus that of the unloaded"
                  " arc is the deflection."},
    GlossaryEntry{"weak-direction", "weak",
                  "A combination of parameters that the data fix no better than 0.3 of "
                  "their scale; its loadings say which, as +0.7 E +0.7 r.",
                  "The single values in it may be far off while the combination that "
                  "matters is right. Hold one of them by --fix, or record a trial in "
                  "which they act differently. Eigenvalue 0: not seen at all."},
};

}  // namespace

std::span<const GlossaryEntry> Glossary() { return kWords; }

}  // namespace hoplab
