// Run folders of every kind, made by the program under test.
import {execFileSync} from 'node:child_process';
import {mkdirSync, readFileSync, rmSync} from 'node:fs';
import {join} from 'node:path';
import {makeUpStudy} from './made_up_study.mjs';

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
  hoplab('diagnose', 'windy', '--effects', 'air_drag,guide_viscous_friction,ground_slope,sensor_delay', '--quiet', '--out', 'diagnose');
  hoplab('gait', scenario('controlled-hopping'), '--along', 'theta_td=0.6:0.8', '--quiet', '--out', 'gait');
  hoplab('optimize', scenario('fastest-convergence'), '--seeds', '2', '--budget', '40', '--map', '6', '--quiet', '--out', 'optimize');
  hoplab('sweep', scenario('modulus'), '--quiet', '--out', 'sweep');
  const short = ['--set', 'stop.time_s=4'];
  hoplab('simulate', scenario('controlled-hopping'), ...short, '--out', 'simulate');
  hoplab('simulate', scenario('controlled-hopping'), ...short, '--set', 'controller.kp_N_s=2', '--out', 'simulate-2');
  makeUpStudy(join(out, 'reproduce'), [join(out, 'simulate'), join(out, 'simulate-2')]);
  hoplab('report', 'reproduce');
}

export const recordOf = (kind) => JSON.parse(readFileSync(join(out, kind, 'run.json'), 'utf8'));
export const pageOf = (kind) => `file://${join(out, kind, 'report.html')}`;
