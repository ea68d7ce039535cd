% One stance by Octave's ode45 with an event function: the kind of tool the thesis used.
%
% usage: octave-cli octave_stance.m PROBLEM.json REPETITIONS
%
% Problem and output as in scipy_stance.py; the law written out again from the equation sheet
% (model/README.md: M2, M2b, M9b-M14). ode45 is Dormand-Prince 5(4), like Odeint's dopri5.
1;
warning ("off", "integrate_adaptive:unexpected_termination");

% C, C2 [m/N, m/N^2] and derivatives in phi (M2, M2b, closed forms: phi > 1).
function [c, c1, c_2, c2, c21] = compliance (phi, p)
  si = sin (phi); co = cos (phi);
  h = 0.5 * phi; s = sin (h); k = cos (h);
  ei = p.E * p.I;
  bending = 0.5 * p.r^3 / ei; axial = 0.5 * p.r / (p.E * p.A);
  shear = 0.5 * p.kappa * p.r / (p.G * p.A);
  c = bending * (2*phi - 3*si + phi*co) + axial * (3*si - phi) + shear * (phi - si);
  c1 = bending * (2 - 2*co - phi*si) + axial * (3*co - 1) + shear * (1 - co);
  c_2 = bending * (si - phi*co) - 3*axial*si + shear*si;
  second = p.r^5 / ei^2;
  c2 = second * (3*h*h*s*k*k + 9*h*k^3 - 1.5*h*k - 8.5*s*k*k + s);
  c21 = second * 0.5 * (h*h*k*(3*k*k - 6*s*s) - 21*h*s*k*k + 1.5*h*s + 16.5*s*s*k);
end

% Chord force [N], contact lead [m], chord length [m] in rolling stance: M9b, M10b by Newton.
function [force, u, l] = arc_chord (z, p)
  persistent phi;
  if (isempty (z))
    phi = pi - p.theta_td;   % a new stance
    return;
  end
  r = p.r; y = z(2);
  for round = 1:30
    s = sin (0.5 * phi); k = cos (0.5 * phi);
    u = z(5) + r*phi - z(1);
    l = sqrt (u*u + y*y);
    [c, c1, c_2, c2, c21] = compliance (phi, p);
    delta = 2*r*s - l;
    root = sqrt (c*c + 4*c2*delta);
    f = 2*delta / (c + root);
    residual = u/l - k + f*(0.5*c1 + f*c21/3)/r;
    f_phi = (r*(k - u/l) - f*c1 - f*f*c21) / root;
    slope = r*y*y/l^3 + 0.5*s + (0.5*c1 + 2/3*f*c21)*f_phi/r + 0.5*f*c_2/r;
    step = -residual / slope;
    phi = phi + step;
    if (abs (step) < 1e-10)
      break;
    end
  end
  u = z(5) + r*phi - z(1);
  l = sqrt (u*u + y*y);
  [c, c1, c_2, c2, c21] = compliance (phi, p);
  delta = 2*r*sin (0.5*phi) - l;
  force = 2*delta / (c + sqrt (c*c + 4*c2*delta)) - p.d*(y*z(4) - u*z(3))/l;
end

% The same for a linear spring and damper between the hip and a fixed toe.
function [force, u, l] = straight_chord (z, p)
  u = z(5) - z(1);
  l = sqrt (u*u + z(2)*z(2));
  force = p.k*(p.l0 - l) - p.d*(z(2)*z(4) - u*z(3))/l;
end

function dz = derivative (t, z, p, chord)
  global rhs_calls;
  rhs_calls++;
  [force, u, l] = chord (z, p);
  dz = [z(3); z(4); -force*u/(l*p.m); force*z(2)/(l*p.m) - p.g; 0];
end

function [value, terminal, direction] = liftoff (t, z, p, chord)
  value = chord (z, p);
  terminal = 1;
  direction = -1;
end

% Lift-off time by ode45's events, and that time polished. ode45 places an event by a straight line
% between two steps, off by 1e-6 s here; the polished time (secant on runs without events that end at
% the event) is there to show that the problem is the same one. Only the plain run is timed.
function [time, polished] = stance (problem)
  p = problem.parameters;
  z = problem.state(:);
  if (strcmp (problem.law, "large_deflection"))
    chord = @arc_chord;
    arc_chord ([], p);
    z(5) = z(1) + p.r*sin (p.theta_td) - p.r*(pi - p.theta_td);
  else
    chord = @straight_chord;
    z(5) = z(1) + p.l0*sin (p.theta_td);
  end
  rhs = @(t, z) derivative (t, z, p, chord);
  tolerances = odeset ("RelTol", problem.relative_tolerance, ...
                       "AbsTol", problem.absolute_tolerance);
  options = odeset (tolerances, "Events", @(t, z) liftoff (t, z, p, chord));
  [~, ~, event_times] = ode45 (rhs, [0, 1], z, options);
  time = event_times(1);
  if (nargout < 2)
    return;
  end
  a = time - 1e-5;
  b = time;
  value_a = guard_at (a, z, p, rhs, chord, tolerances);
  for round = 1:4
    value_b = guard_at (b, z, p, rhs, chord, tolerances);
    polished = b - value_b*(b - a) / (value_b - value_a);
    if (abs (polished - b) < 1e-11)
      return;
    end
    a = b; value_a = value_b; b = polished;
  end
end

function value = guard_at (time, z, p, rhs, chord, tolerances)
  [~, states] = ode45 (rhs, [0, time], z, tolerances);
  value = chord (states(end, :), p);
end

words = argv ();
problem = jsondecode (fileread (words{1}));
global rhs_calls = 0;
stance (problem);   % also warms up
calls = rhs_calls;
[time, polished] = stance (problem);
seconds = zeros (1, str2double (words{2}));
for i = 1:numel (seconds)
  tic ();
  stance (problem);
  seconds(i) = toc ();
end
printf (["{\"liftoff_time_s\": %.17g, \"own_liftoff_time_s\": %.17g, \"rhs_calls\": %d, ", ...
         "\"seconds\": [%s], \"version\": \"%s\"}\n"], polished, time, calls, ...
        strjoin (arrayfun (@(x) sprintf ("%.9g", x), seconds, "UniformOutput", false), ", "), ...
        version ());
