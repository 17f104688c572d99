// SPDX-License-Identifier: Apache-2.0
import { remarksOf } from '../data/remarks';
import type { TrackingReport } from '../data/report';
import { Shared, type Selection } from '../data/selection';
import { errorSection } from '../tables/errors';
import { eventSection } from '../tables/events';
import { optionSection } from '../tables/options';
import { summarySection } from '../tables/summary';
import { targetSection } from '../tables/targets';
import type { PageContent } from './frame';
import { workspace } from './workspace';

const kReading = [
  'Frame "tracker": the left camera; x right, y down, z forward. Lengths in mm, angles in degrees, time in s, images in px.',
  'A pose is tracker_from_body. Accuracy is told at the named point of each body: at the end of a lever arm a small turn is a large shift.',
  'Error is measured less true, along the tracker\'s axes; rotations as a rotation vector.',
  'The 95 % band is what the tracker stated by itself, without knowing the truth: ±1.96 σ along an axis; for the size of an error the bound that its length stays below with probability 95 %.',
  'The ellipsoid holds the named point with probability 95 %; it is enlarged by the factor written under the view.',
  '"measured" uses one frame alone; "filtered" carries knowledge from earlier frames on. A predicted pose was not measured and is drawn dashed; an ambiguous or lost one is not drawn.',
];

const kKeys = '← → step a frame, with Shift ten, Space plays. Point into a plot to see that frame; drag in a plot to look closer, double-click for the whole time.';

/// The page about a tracked recording.
export function trackingPage(report: TrackingReport): PageContent {
  const shared = new Shared<Selection>({
    frame: 0, body: 0, component: 'size', range: null,
    source: 'measured',
  });
  const work = report.frames.frame.length > 0 ? workspace(report, shared) : null;
  const nothing = report.frames.frame.length > 0 ? 'Nothing: every body was OK in every frame.' : 'There are no frames.';
  return {
    sections: [
      summarySection(report.summary, remarksOf(report), 'What went wrong', nothing), work?.element ?? null, errorSection(report), targetSection(report),
      eventSection(report, shared), optionSection(report.options, report.rig, kReading),
    ],
    keys: kKeys,
    refresh: () => work?.refresh(),
    beforePrint: () => work?.beforePrint(),
  };
}
