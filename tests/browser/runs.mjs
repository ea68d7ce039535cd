// Run folders of every kind, made by the program under test.
import {execFileSync} from 'node:child_process';
import {mkdirSync, readFileSync, rmSync} from 'node:fs';
import {join} from 'node:path';

const source = process.env.HOPLAB_SOURCE;
export const out = process.env.HOPLAB_BROWSER_OUT;

const hoplab = (...words) => execFileSync(process.env.HOPLAB, words, {cwd: out, stdio: ['ignore', 'ignore', 'inherit']});

export function makeRuns() {
  rmSync(out, {recursive: true, force: true});
  mkdirSync(out, {recursive: true});
  const scenario = (name) => join(source, 'experiments', `${name}.yaml`);
  hoplab('check', join(source, 'datasets/rig-drops'), '--out', 'check');
  hoplab('fit', join(source, 'datasets/rig-drops'), '--profile', 'E', '--quiet', '--out', 'fit');
  hoplab('generate', scenario('three-drops'), '--with', 'air_drag:c_drag=0.05', '--seed', '7', '--out', 'windy');
  hoplab('fit', 'windy', '--quiet', '--out', 'windy-fit');
  hoplab('report', 'fit', 'windy-fit', '--out', 'report');
  hoplab('diagnose', 'windy', '--effects', 'air_drag,guide_viscous_friction,ground_slope,sensor_delay', '--quiet', '--out', 'diagnose');
  hoplab('discover', 'windy', '--quiet', '--out', 'discover');
  hoplab('design', join(source, 'datasets/rig-drops'), '--sharpen', 'E', '--budget', '60', '--map', '5', '--quiet', '--out', 'design');
  hoplab('gait', scenario('controlled-hopping'), '--along', 'theta_td=0.6:0.8', '--quiet', '--out', 'gait');
  hoplab('optimize', scenario('fastest-convergence'), '--seeds', '2', '--budget', '40', '--map', '6', '--quiet', '--out', 'optimize');
  hoplab('sweep', scenario('modulus'), '--quiet', '--out', 'sweep');
  hoplab('simulate', scenario('controlled-hopping'), '--set', 'stop.time_s=4', '--out', 'simulate');
  hoplab('reproduce', 'table-6.4', 'table-6.5', 'figure-6.23', 'figure-6.29', 'figure-3.5', 'figure-3.6', 'claim-h', '--constants', scenario('published'), '--quiet', '--out', 'reproduce');
}

export const recordOf = (kind) => JSON.parse(readFileSync(join(out, kind, 'run.json'), 'utf8'));
export const pageOf = (kind) => `file://${join(out, kind, 'report.html')}`;
